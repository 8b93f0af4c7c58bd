# With catkin and every ROS package of package.xml found: messages, devel space, nodes. Without: the same rooms and
# tools as a plain CMake project. Sets
#   MONOCULAR_EYE_HAND_WITH_ROS                    whether messages and nodes are built
#   MONOCULAR_EYE_HAND_{LIB,BIN,SHARE,INCLUDE}_DESTINATION   install folders, relative to the prefix
#   CMAKE_INSTALL_RPATH                            from programs and libraries to the libraries, wherever they are moved
#   MONOCULAR_EYE_HAND_TEST_RESULTS                where the tests leave their XML
#   ros_node(<name> SOURCES <file>... [LINK <target>...])                program <name> of the package
#   ros_test(<file>.test [DEPENDENCIES <target>...])                      rostest: alone, with its own ROS_HOME
set(MONOCULAR_EYE_HAND_ROS_PACKAGES  # each after those it requires itself
  std_msgs geometry_msgs sensor_msgs visualization_msgs actionlib_msgs rosgraph_msgs trajectory_msgs roscpp actionlib
  cv_bridge tf2_ros image_transport camera_info_manager diagnostic_updater)

# ROS is installed for the system's python; another one first on the PATH knows none of its modules.
if(NOT PYTHON_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that catkin and the message generators run on")
  set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE} CACHE FILEPATH "The same, for CMake's newer search")
endif()

set(missing "")
if(MONOCULAR_EYE_HAND_ROS)
  # catkin freezes the environment of the tests when it is found, without the folders that are not there yet: on a first
  # configuration the tests would not find the python messages.
  if(CATKIN_DEVEL_PREFIX)
    file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages)
  else()
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)
  endif()
  foreach(package catkin message_generation message_runtime ${MONOCULAR_EYE_HAND_ROS_PACKAGES})
    find_package(${package} QUIET)
    if(NOT ${package}_FOUND)  # looking further would end in the errors of packages that require this one
      set(missing ${package})
      break()
    endif()
  endforeach()
endif()

if(NOT MONOCULAR_EYE_HAND_ROS OR missing)
  if(missing)
    message(STATUS "${PROJECT_NAME}: WITHOUT ROS, not found: ${missing}. Rooms and tools are built, messages and nodes are not.")
  else()
    message(STATUS "${PROJECT_NAME}: WITHOUT ROS, as asked. Rooms and tools are built, messages and nodes are not.")
  endif()
  set(MONOCULAR_EYE_HAND_WITH_ROS FALSE)
  include(GNUInstallDirs)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  set(MONOCULAR_EYE_HAND_LIB_DESTINATION ${CMAKE_INSTALL_LIBDIR})
  set(MONOCULAR_EYE_HAND_BIN_DESTINATION ${CMAKE_INSTALL_BINDIR})
  set(MONOCULAR_EYE_HAND_SHARE_DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME})
  set(MONOCULAR_EYE_HAND_INCLUDE_DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  file(RELATIVE_PATH lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/${lib_from_bin}")
  set(MONOCULAR_EYE_HAND_TEST_RESULTS ${CMAKE_BINARY_DIR}/test_results/${PROJECT_NAME})
  return()
endif()

message(STATUS "${PROJECT_NAME}: with ROS: messages and nodes are built.")
set(MONOCULAR_EYE_HAND_WITH_ROS TRUE)
find_package(catkin REQUIRED COMPONENTS message_generation ${MONOCULAR_EYE_HAND_ROS_PACKAGES})
if(NOT CATKIN_ENABLE_TESTING)
  set(MONOCULAR_EYE_HAND_TESTS OFF)
endif()
add_message_files(FILES
  PoseAlternative.msg RecognizedObject.msg RecognizedObjectArray.msg LocatedObject.msg LocatedObjectArray.msg
  GraspTarget.msg GraspTargetArray.msg GripperState.msg ClearedObject.msg WorkCellObject.msg WorkCellTruth.msg)
add_service_files(FILES Recognize.srv GraspTargets.srv ForgetObject.srv)
add_action_files(FILES Pick.action Place.action Move.action Recover.action ClearFrame.action)
generate_messages(DEPENDENCIES actionlib_msgs geometry_msgs sensor_msgs std_msgs)

set(libraries ${MONOCULAR_EYE_HAND_ROOMS})
list(TRANSFORM libraries PREPEND monocular_eye_hand_)
set(YAML_CPP_LIBRARIES yaml-cpp)
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${libraries}
  CATKIN_DEPENDS message_runtime ${MONOCULAR_EYE_HAND_ROS_PACKAGES}
  DEPENDS EIGEN3 OpenCV YAML_CPP)

set(MONOCULAR_EYE_HAND_LIB_DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
set(MONOCULAR_EYE_HAND_BIN_DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
set(MONOCULAR_EYE_HAND_SHARE_DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
set(MONOCULAR_EYE_HAND_INCLUDE_DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/..")
set(MONOCULAR_EYE_HAND_TEST_RESULTS ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME})

function(ros_node name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target monocular_eye_hand_node_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${catkin_INCLUDE_DIRS})
  target_link_libraries(${target} PRIVATE ${ARG_LINK} ${catkin_LIBRARIES})
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  add_dependencies(${target} ${PROJECT_NAME}_generate_messages_cpp)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  in_batches(${target})
  precompile(${target} node)
  set_property(GLOBAL APPEND PROPERTY MONOCULAR_EYE_HAND_PROGRAMS ${target})
endfunction()

if(CATKIN_ENABLE_TESTING AND MONOCULAR_EYE_HAND_TESTS)
  find_package(rostest REQUIRED)
  find_package(roslaunch REQUIRED)  # roslaunch_add_file_check()
endif()

function(ros_test file)
  add_rostest(${file} ${ARGN})
  get_filename_component(name ${file} NAME)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE "/" "_" folder ${folder})
  set_tests_properties(_ctest_${PROJECT_NAME}_rostest_${folder}_${name} PROPERTIES
    RUN_SERIAL TRUE TIMEOUT 600 LABELS nodes
    ENVIRONMENT "ROS_HOME=${PROJECT_BINARY_DIR}/ros_home;ROS_IP=127.0.0.1;ROS_HOSTNAME=127.0.0.1")
endfunction()
