# What lands where; the folders come from cmake/ros.cmake.
get_property(libraries GLOBAL PROPERTY MONOCULAR_EYE_HAND_LIBRARIES)
get_property(helpers GLOBAL PROPERTY MONOCULAR_EYE_HAND_HELPERS)
get_property(programs GLOBAL PROPERTY MONOCULAR_EYE_HAND_PROGRAMS)
set(share ${MONOCULAR_EYE_HAND_SHARE_DESTINATION})

install(TARGETS ${libraries} EXPORT ${PROJECT_NAME}
  LIBRARY DESTINATION ${MONOCULAR_EYE_HAND_LIB_DESTINATION})
install(TARGETS ${helpers} RUNTIME DESTINATION ${MONOCULAR_EYE_HAND_LIB_DESTINATION}/${PROJECT_NAME})
if(programs)
  install(TARGETS ${programs} RUNTIME DESTINATION ${MONOCULAR_EYE_HAND_BIN_DESTINATION})
endif()
install(DIRECTORY include/${PROJECT_NAME}/
  DESTINATION ${MONOCULAR_EYE_HAND_INCLUDE_DESTINATION}/${PROJECT_NAME} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY config models data DESTINATION ${share})
install(DIRECTORY urdf DESTINATION ${share} FILES_MATCHING PATTERN "*.urdf" PATTERN "*.stl")
if(MONOCULAR_EYE_HAND_WITH_ROS)
  install(DIRECTORY launch rviz DESTINATION ${share})
  install(PROGRAMS scripts/ask scripts/clear_frame.py scripts/play_bag
    DESTINATION ${MONOCULAR_EYE_HAND_BIN_DESTINATION})
else()  # catkin writes its own package configuration
  include(CMakePackageConfigHelpers)
  set(cmake_files ${MONOCULAR_EYE_HAND_LIB_DESTINATION}/cmake/${PROJECT_NAME})
  install(EXPORT ${PROJECT_NAME} NAMESPACE ${PROJECT_NAME}:: FILE ${PROJECT_NAME}-targets.cmake
    DESTINATION ${cmake_files})
  configure_package_config_file(cmake/config.cmake.in ${PROJECT_BINARY_DIR}/${PROJECT_NAME}-config.cmake
    INSTALL_DESTINATION ${cmake_files})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/${PROJECT_NAME}-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/${PROJECT_NAME}-config.cmake
    ${PROJECT_BINARY_DIR}/${PROJECT_NAME}-config-version.cmake DESTINATION ${cmake_files})
endif()
