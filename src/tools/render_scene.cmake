tool(render_scene SOURCES render_scene.cpp demo_scenes.cpp
  LINK monocular_eye_hand_simulation monocular_eye_hand_model opencv_imgcodecs CLI11::CLI11)
