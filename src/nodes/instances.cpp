#include "nodes/instances.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <tuple>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void requireNotNegative(const char* field, double value) {
  if (value >= 0) return;
  std::ostringstream text;
  text << field << " = " << value << " must not be negative";
  throw BadInput(text.str());
}

}  // namespace

void InstanceOptions::check() const {
  requireNotNegative("forget_after", forget_after);
  requireNotNegative("speed", speed);
}

Instances::Instances(const ModelBase& models, const InstanceOptions& options) : options_(options) {
  options.check();
  for (const KnownObject& known : models.objects)
    shapes_.push_back({known.model.centre(), known.model.diameter});
}

std::vector<int> Instances::assign(const std::vector<ObjectEstimate>& objects, double stamp) {
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [&](const Track& track) { return !alive(track, stamp); }),
                tracks_.end());

  std::vector<std::tuple<double, size_t, size_t>> pairs;  // distance, track, object
  for (size_t t = 0; t < tracks_.size(); ++t)
    for (size_t i = 0; i < objects.size(); ++i) {
      if (objects[i].object != tracks_[t].object.object) continue;
      const double reach =
          shapes_.at(size_t(objects[i].object)).diameter / 2 + options_.speed * (stamp - tracks_[t].stamp);
      const double d = distance(objects[i], tracks_[t].object);
      if (d <= reach) pairs.emplace_back(d, t, i);
    }

  std::sort(pairs.begin(), pairs.end());
  std::vector<int> numbers(objects.size(), -1);
  std::vector<bool> taken(tracks_.size(), false);
  for (const auto& [d, t, i] : pairs) {
    if (taken[t] || numbers[i] >= 0) continue;
    taken[t] = true;
    numbers[i] = tracks_[t].number;
    tracks_[t].object = objects[i];
    tracks_[t].stamp = stamp;
  }

  for (size_t i = 0; i < objects.size(); ++i) {
    if (numbers[i] >= 0) continue;
    numbers[i] = freeNumber(objects[i].object);
    tracks_.push_back({objects[i], numbers[i], stamp});
  }
  return numbers;
}

std::vector<ObjectEstimate> Instances::previous(double stamp) const {
  std::vector<ObjectEstimate> objects;
  for (const Track& track : tracks_)
    if (alive(track, stamp)) objects.push_back(track.object);
  return objects;
}

bool Instances::alive(const Track& track, double stamp) const {
  return stamp >= track.stamp && stamp - track.stamp <= options_.forget_after;
}

double Instances::distance(const ObjectEstimate& a, const ObjectEstimate& b) const {
  const Eigen::Vector3d& centre = shapes_.at(size_t(a.object)).centre;
  return (a.camera_from_object * centre - b.camera_from_object * centre).norm();
}

int Instances::freeNumber(int object) const {
  int number = 0;
  const auto used = [&](const Track& track) {
    return track.object.object == object && track.number == number;
  };
  while (std::any_of(tracks_.begin(), tracks_.end(), used)) ++number;
  return number;
}

std::string objectFrame(const std::string& prefix, const std::string& name, int number) {
  std::string frame = prefix + name;
  for (char& c : frame)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '.' && c != '/') c = '_';
  return frame + "_" + std::to_string(number);
}

}  // namespace monocular_eye_hand
