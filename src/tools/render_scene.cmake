tool(render_scene SOURCES render_scene.cpp bop_output.cpp demo_scenes.cpp
  LINK monocular_eye_hand_simulation monocular_eye_hand_model monocular_eye_hand_evaluation opencv_imgcodecs CLI11::CLI11)
