room_benchmark(pose SOURCES pose_benchmark.cpp)
target_include_directories(bench_pose PRIVATE ${PROJECT_SOURCE_DIR}/test/pose)
