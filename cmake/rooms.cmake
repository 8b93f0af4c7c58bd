# One room = one library with an explicit source list; its link line is the architecture diagram. A header of its own
# stands in src/<name>/ and is included as "<name>/x.h"; only include/ is installed.
#   room(<name> SOURCES <file>... [LINK <target>...])       library monocular_eye_hand_<name>, sources in src/<name>/
#   tool(<name> SOURCES <file>... [LINK <target>...])       program <name>, target monocular_eye_hand_tool_<name>
#   helper(<name> SOURCES <file>... [LINK <target>...])     program that a room starts, in a folder beside its library
#   room_test(<room> SOURCES <file>... [LINK ...])        gtest of test/<room>/, one program for all its files, built by the
#                                                         target `tests`, run by ctest; "support/x.h" is of several rooms
#   room_test(<room> <name> SOURCES ...)                  another program beside it, where one has to be for itself
# The sources of a room, of its tests, of a program are compiled in batches of eight: their common templates are made
# once, which takes half the time. Who works on a room compiles less after each change with -DMONOCULAR_EYE_HAND_UNITY_BUILD=OFF.
include(CMakeParseArguments)
option(MONOCULAR_EYE_HAND_UNITY_BUILD "Compile the sources of a room in batches" ON)

function(in_batches target)
  if(MONOCULAR_EYE_HAND_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # it takes a source of a batch for a header
  endif()
endfunction()

function(room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target monocular_eye_hand_${name})
  add_library(${target} SHARED ${ARG_SOURCES})
  add_library(monocular_eye_hand::${name} ALIAS ${target})
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PUBLIC ${ARG_LINK} PRIVATE fmt::fmt)  # no public header shows fmt
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  # A room runs its own code of the inline functions that it uses, not that of a program compiled with other options.
  target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} DEFINE_SYMBOL "")
  in_batches(${target})
  precompile(${target} library)
  set_property(GLOBAL APPEND PROPERTY MONOCULAR_EYE_HAND_LIBRARIES ${target})
endfunction()

function(tool name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target monocular_eye_hand_tool_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PRIVATE ${ARG_LINK} fmt::fmt)
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  in_batches(${target})
  precompile(${target} program)
  set_property(GLOBAL APPEND PROPERTY MONOCULAR_EYE_HAND_PROGRAMS ${target})
endfunction()

function(helper name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target monocular_eye_hand_helper_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PRIVATE ${ARG_LINK})
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name}
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${PROJECT_NAME})
  set_property(GLOBAL APPEND PROPERTY MONOCULAR_EYE_HAND_HELPERS ${target})
endfunction()

if(MONOCULAR_EYE_HAND_TESTS)
  enable_testing()
  find_package(GTest REQUIRED)
  if(NOT TARGET tests)
    add_custom_target(tests)
  endif()
endif()

# Replaces the operators new and delete of a test program by counting ones; not in one batch with code that calls them.
set(allocation_count ${PROJECT_SOURCE_DIR}/test/support/allocation_count.cpp)

function(room_test room)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  string(JOIN _ name ${room} ${ARG_UNPARSED_ARGUMENTS})
  set(target test_${name})
  add_executable(${target} EXCLUDE_FROM_ALL ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE
    ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${target} ${ARG_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  if(TARGET monocular_eye_hand_${room})
    target_link_libraries(${target} monocular_eye_hand_${room})
  endif()
  target_compile_options(${target} PRIVATE -Wall -Wextra ${quick_to_compile})
  target_compile_definitions(${target} PRIVATE MONOCULAR_EYE_HAND_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  in_batches(${target})
  set_source_files_properties(${allocation_count} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if("${room}" STREQUAL "nodes")
    precompile(${target} node_test)
  else()
    precompile(${target} test)
  endif()
  # Not in the devel space: rosrun would offer the tests as programs of the package.
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test/${room})
  add_dependencies(tests ${target})
  set(binary ${PROJECT_BINARY_DIR}/test/${room}/${target})
  set(results gtest-${target}.xml)
  if(MONOCULAR_EYE_HAND_WITH_ROS)  # also run by `run_tests`; a test that dies without a result counts as failed
    catkin_run_tests_target("gtest" ${target} ${results} DEPENDENCIES ${target}
      COMMAND "${binary} --gtest_output=xml:${MONOCULAR_EYE_HAND_TEST_RESULTS}/${results}")
    set(test _ctest_${PROJECT_NAME}_gtest_${target})
  else()
    set(test ${name})
    add_test(NAME ${test} COMMAND ${binary} --gtest_output=xml:${MONOCULAR_EYE_HAND_TEST_RESULTS}/${results})
  endif()
  set_tests_properties(${test} PROPERTIES TIMEOUT 1200 LABELS ${room})
endfunction()
