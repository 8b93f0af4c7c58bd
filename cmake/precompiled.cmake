# The headers that most files begin with, those of the standard library and of libraries that do not change with the
# package, are parsed once for all files: a file compiles in half the time. A header of the package is never among them.
#   precompile(<target> <kind>)    kind: library (position-independent), program, test, node, node_test
# Code with compile options of its own cannot use them and is left out where it sets those options.
# Each file still includes what it uses: -DMONOCULAR_EYE_HAND_PRECOMPILED_HEADERS=OFF builds without.
set(quick_to_compile $<$<NOT:$<CONFIG:Debug>>:-O1>)  # the tests' own code runs once, the rooms' is compiled for speed
option(MONOCULAR_EYE_HAND_PRECOMPILED_HEADERS "Parse the headers of other libraries once" ON)

# The object library that owns the parsed headers of a kind.
function(precompiled_headers owner kind)
  set(source ${PROJECT_BINARY_DIR}/precompiled/${kind}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${owner} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${owner} PRIVATE Eigen3::Eigen opencv_core opencv_imgproc)
  target_compile_options(${owner} PRIVATE -Wall -Wextra)

  set(headers ${PROJECT_SOURCE_DIR}/cmake/precompiled.h)
  if("${kind}" STREQUAL "library")
    set_target_properties(${owner} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    list(APPEND headers <fmt/format.h>)
    target_link_libraries(${owner} PRIVATE fmt::fmt)
  endif()
  if("${kind}" MATCHES "node")
    list(APPEND headers ${PROJECT_SOURCE_DIR}/src/nodes/common/precompiled.h)
    target_include_directories(${owner} PRIVATE ${catkin_INCLUDE_DIRS})
    target_link_libraries(${owner} PRIVATE ${catkin_LIBRARIES})
  endif()
  if("${kind}" MATCHES "test")
    list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
    target_compile_options(${owner} PRIVATE ${quick_to_compile})
    target_link_libraries(${owner} PRIVATE GTest::gtest GTest::gmock)
  endif()
  target_precompile_headers(${owner} PRIVATE ${headers})
endfunction()

function(precompile target kind)
  if(NOT MONOCULAR_EYE_HAND_PRECOMPILED_HEADERS)
    return()
  endif()
  set(owner monocular_eye_hand_precompiled_${kind})
  if(NOT TARGET ${owner})
    precompiled_headers(${owner} ${kind})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()
