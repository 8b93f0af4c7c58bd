tool(model_check
  SOURCES model_check.cpp model_picture.cpp
  LINK monocular_eye_hand_model opencv_core opencv_imgproc opencv_imgcodecs nlohmann_json::nlohmann_json CLI11::CLI11)
