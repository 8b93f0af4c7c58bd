#include "tools/clearing_pictures.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "monocular_eye_hand/drawing/canvas.h"
#include "monocular_eye_hand/geometry/look_at.h"
#include "monocular_eye_hand/report/result_drawing.h"
#include "monocular_eye_hand/simulation/render/render.h"

namespace monocular_eye_hand {
namespace {

// Of the picture of the end: from where the whole table is in view.
constexpr double kAzimuth = -M_PI, kElevation = 1.15, kDistance = 1.25;  // [rad, m]
const Camera kCamera{960, 720, 900, 900, 479.5, 359.5, DistortionModel::kNone, {}};

const char* kindOf(const TaskView& view) {
  if (view.near) return "near";
  return view.overview < 0 ? "search" : "overview";
}

}  // namespace

ClearingPictures::ClearingPictures(std::string folder, const ModelBase& models)
    : folder_(std::move(folder)), models_(models) {}

void ClearingPictures::watch(ClearingWatch* watch) {
  watch->looked = [this](const CellLook& look) { looked(look); };
  watch->ended = [this](const WorkCell& cell) { ended(cell); };
}

void ClearingPictures::looked(const CellLook& look) {
  char file[64];
  std::snprintf(file, sizeof file, "%02d_%s.png", count_++, kindOf(look.view));
  const std::string path = (std::filesystem::path(folder_) / file).string();
  writePicture(path, drawResult(look.grey, look.camera, models_, look.result));
}

void ClearingPictures::ended(const WorkCell& cell) const {
  Scene scene = cell.scene().scene;
  scene.world_from_camera = lookFrom(kAzimuth, kElevation, kDistance, {-0.02, 0.12, 0});
  writePicture((std::filesystem::path(folder_) / "end.png").string(), renderScene(scene, kCamera).grey);
}

}  // namespace monocular_eye_hand
