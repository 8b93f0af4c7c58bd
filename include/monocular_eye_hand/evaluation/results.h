#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// One row of a BOP results file: scene_id,im_id,obj_id,score,R,t,time.
struct BopResult {
  int scene = 0;
  int image = 0;
  int object = 0;  ///< BopModel::id
  double score = 0;
  Rigid3 camera_from_object;  ///< metres; millimetres in the file
  double time = -1;           ///< seconds for the whole image, the same in all its rows; -1 = not measured
};

/// Writes with the header line and enough digits to read back the same poses. Throws BadInput when it cannot.
void writeBopResults(const std::string& path, const std::vector<BopResult>& results);
/// Strict: seven fields per row, nine and three numbers, all finite, R a rotation to 1e-3, one time per image
/// (to 1 ms). The header is optional. Throws BadInput naming file, line and fault.
std::vector<BopResult> readBopResults(const std::string& path);

/// Seconds per image by (scene, image): the file scene_id,im_id,time beside a results file.
using ImageTimes = std::map<std::pair<int, int>, double>;
void writeImageTimes(const std::string& path, const ImageTimes& times);
ImageTimes readImageTimes(const std::string& path);
/// R.csv -> R.times.csv.
std::string imageTimesPath(const std::string& results_path);

}  // namespace monocular_eye_hand
