# Paths beside those of OMPL and FCL used directly; whole picks in random scenes.
room_benchmark(planning SOURCES planning_benchmark.cpp planning_peer.cpp
  LINK monocular_eye_hand_model fcl ${OMPL_LIBRARIES})
target_include_directories(bench_planning PRIVATE ${PROJECT_SOURCE_DIR}/test)
target_include_directories(bench_planning SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
