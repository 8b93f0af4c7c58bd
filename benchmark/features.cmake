# Speed, accuracy and coverage of the features beside OpenCV's EdgeDrawing (ximgproc) and LSD.
find_package(OpenCV REQUIRED COMPONENTS ximgproc)
room_benchmark(features
  SOURCES features_benchmark.cpp features_bench_sets.cpp features_detectors.cpp features_front_end.cpp
    features_segments.cpp features_ellipses.cpp features_coverage.cpp features_covariance.cpp
  LINK monocular_eye_hand_model monocular_eye_hand_evaluation opencv_imgproc opencv_imgcodecs opencv_ximgproc)
