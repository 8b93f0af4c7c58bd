# One room = one library with an explicit source list; its link line is the architecture diagram.
#   room(<name> SOURCES <file>... [LINK <target>...])      library monocular_eye_hand_<name>, sources in src/<name>/
#   room_test(<room> <name> SOURCES <file>... [LINK ...])   gtest in test/<room>/, built by the target `tests`, run by ctest
include(CMakeParseArguments)

function(room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target monocular_eye_hand_${name})
  add_library(${target} SHARED ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} PUBLIC ${ARG_LINK})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  set_property(GLOBAL APPEND PROPERTY MONOCULAR_EYE_HAND_ROOMS ${target})
endfunction()

function(room_test room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  if(NOT MONOCULAR_EYE_HAND_TESTS)
    return()
  endif()
  set(target test_${room}_${name})
  add_executable(${target} EXCLUDE_FROM_ALL ${ARG_SOURCES})
  target_link_libraries(${target} monocular_eye_hand_${room} ${ARG_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  target_compile_definitions(${target} PRIVATE
    MONOCULAR_EYE_HAND_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  add_dependencies(tests ${target})
  set(results ${MONOCULAR_EYE_HAND_TEST_RESULTS}/gtest-${target}.xml)
  add_test(NAME ${room}.${name} COMMAND ${target} --gtest_output=xml:${results})
endfunction()
