room_benchmark(pose SOURCES pose_benchmark.cpp)
target_include_directories(bench_pose PRIVATE ${PROJECT_SOURCE_DIR}/test)
# Three points, beside OpenCV's AP3P.
room_benchmark(p3p ROOM pose SOURCES p3p_benchmark.cpp p3p_problems.cpp p3p_peer.cpp p3p_reference.cpp
  LINK opencv_calib3d opencv_core)
target_include_directories(bench_p3p PRIVATE ${PROJECT_SOURCE_DIR}/test)
# Refinement, beside Ceres.
find_package(Ceres REQUIRED)
room_benchmark(refine ROOM pose SOURCES refine_benchmark.cpp refine_peer.cpp LINK Ceres::ceres)
target_include_directories(bench_refine PRIVATE ${PROJECT_SOURCE_DIR}/test)
# A circle and a point.
room_benchmark(circle ROOM pose SOURCES circle_benchmark.cpp p3p_problems.cpp)
target_include_directories(bench_circle PRIVATE ${PROJECT_SOURCE_DIR}/test)
# What rounding does to the paper's quartic.
benchmark_program(p3p_rounding ROOM pose SOURCES p3p_rounding.cpp p3p_problems.cpp paper_p3p.cpp grant_hitchins.cpp)
target_include_directories(p3p_rounding PRIVATE ${PROJECT_SOURCE_DIR}/test)
