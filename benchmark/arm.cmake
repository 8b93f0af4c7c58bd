# The inverse kinematics beside those of KDL, from Debian's liborocos-kdl-dev.
find_package(orocos_kdl REQUIRED)
room_benchmark(arm SOURCES arm_benchmark.cpp LINK ${orocos_kdl_LIBRARIES})
target_include_directories(bench_arm PRIVATE ${PROJECT_SOURCE_DIR}/test)
target_include_directories(bench_arm SYSTEM PRIVATE ${orocos_kdl_INCLUDE_DIRS})
