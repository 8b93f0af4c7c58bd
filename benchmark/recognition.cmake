# Poses of rendered parts with their covariances.
benchmark_program(pose_covariance ROOM recognition SOURCES pose_covariance.cpp LINK monocular_eye_hand_simulation)
