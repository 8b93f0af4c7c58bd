#pragma once
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "../io/temp_folder.h"

namespace monocular_eye_hand {

/// A tetrahedron with corners (0,0,0), (100,0,0), (0,100,0), (0,0,100) mm; its diameter is 100 sqrt(2) mm.
inline std::string tetrahedronPly() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n100 0 0\n0 100 0\n0 0 100\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

/// A square plate of 200 x 200 x 20 mm about the origin.
inline std::string platePly() {
  return "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 12\nproperty list uchar int vertex_indices\nend_header\n"
         "-100 -100 -10\n100 -100 -10\n100 100 -10\n-100 100 -10\n-100 -100 10\n100 -100 10\n100 100 "
         "10\n-100 100 10\n"
         "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 "
         "4\n3 3 4 7\n";
}

/// Two scenes, objects 1 (tetrahedron) and 5 (plate, half turn about z); f = 1000 px, 640 x 480. Truths,
/// rotation = identity, t in mm: scene 1 image 0: object 1 at (0,0,1000) fully visible and object 5 at
/// (200,0,1000) 30 % visible; image 3: object 1 at (0,0,1000) and at (-200,0,1000), the second 5 % visible;
/// scene 2 image 0: object 5 at (0,0,2000).
inline void writeSmallDataset(const TempFolder& folder) {
  folder.write("models/obj_000001.ply", tetrahedronPly());
  folder.write("models/obj_000005.ply", platePly());
  folder.write("models/models_info.json",
               R"({"1": {"diameter": 141.4213562373095, "name": "tetra"},
 "5": {"diameter": 283.5489375751565,
       "symmetries_discrete": [[-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]]}})");
  folder.write("camera.json",
               R"({"width": 640, "height": 480, "fx": 1000, "fy": 1000, "cx": 319.5, "cy": 239.5})");

  const std::string k = R"({"cam_K": [1000, 0, 319.5, 0, 1000, 239.5, 0, 0, 1], "depth_scale": 1})";
  const auto gt = [](int object, const std::string& t) {
    return R"({"cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_m2c": [)" + t + R"(], "obj_id": )" +
           std::to_string(object) + "}";
  };

  folder.write("dev/000001/scene_camera.json", "{\"0\": " + k + ", \"3\": " + k + "}");
  folder.write("dev/000001/scene_gt.json", "{\"0\": [" + gt(1, "0, 0, 1000") + ", " + gt(5, "200, 0, 1000") +
                                               "], \"3\": [" + gt(1, "0, 0, 1000") + ", " +
                                               gt(1, "-200, 0, 1000") + "]}");
  folder.write(
      "dev/000001/scene_gt_info.json",
      R"({"0": [{"visib_fract": 1.0}, {"visib_fract": 0.3}], "3": [{"visib_fract": 1.0}, {"visib_fract": 0.05}]})");
  folder.write("dev/000002/scene_camera.json", "{\"0\": " + k + "}");
  folder.write("dev/000002/scene_gt.json", "{\"0\": [" + gt(5, "0, 0, 2000") + "]}");
  folder.write("dev/readme.txt", "not a scene");

  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(90));
  image.at<uchar>(7, 5) = 200;
  for (const char* name :
       {"dev/000001/gray/000000.png", "dev/000001/gray/000003.png", "dev/000002/rgb/000000.tif"}) {
    std::filesystem::create_directories(std::filesystem::path(folder.path(name)).parent_path());
    cv::imwrite(folder.path(name), image);
  }
}

}  // namespace monocular_eye_hand
