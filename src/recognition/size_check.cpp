#include "monocular_eye_hand/recognition/size_check.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/io/plain_number.h"

namespace monocular_eye_hand {
namespace {

std::string warningFor(const ObjectModel& model, const Camera& camera, const RecognitionOptions& options) {
  const std::string size = model.name + ": its diameter is " + plainNumber(1000 * model.diameter) + " mm, ";
  const std::string cure = ": is the unit of its mesh right? Else change ";
  const double nearest = options.nearest(model.diameter);
  const double largest = model.diameter * std::max(camera.fx, camera.fy) / nearest;
  if (largest < options.min_size)
    return size + "which at min_distance (" + plainNumber(options.min_distance) + " m) is " +
           plainNumber(largest) + " px of min_size (" + plainNumber(options.min_size) +
           " px), so it is never found" + cure + "min_distance or min_size, or take a longer lens";

  const double shown = options.max_distance * std::hypot(camera.width / camera.fx, camera.height / camera.fy);
  if (model.diameter > shown)
    return size + "more than the " + plainNumber(1000 * shown) +
           " mm that the image shows at max_distance (" + plainNumber(options.max_distance) +
           " m), so it is never seen whole" + cure + "max_distance";
  return "";
}

}  // namespace

std::vector<std::string> sizeWarnings(const ModelBase& models, const Camera& camera,
                                      const RecognitionOptions& options) {
  std::vector<std::string> out;
  for (const KnownObject& known : models.objects) {
    const std::string warning = warningFor(known.model, camera, options);
    if (!warning.empty()) out.push_back(warning);
  }
  return out;
}

}  // namespace monocular_eye_hand
