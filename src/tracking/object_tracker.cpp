#include "monocular_eye_hand/tracking/object_tracker.h"

#include <algorithm>
#include <tuple>

#include "monocular_eye_hand/geometry/require.h"
#include "monocular_eye_hand/model/same_place.h"

namespace monocular_eye_hand {

void ObjectTrackerOptions::check() const {
  require(forget_after >= 0, "forget_after", forget_after, "0 or more");
  require(speed >= 0, "speed", speed, "0 or more");
}

ObjectTracker::ObjectTracker(const ModelBase& models, const ObjectTrackerOptions& options)
    : options_(options) {
  options.check();
  for (const KnownObject& known : models.objects)
    shapes_.push_back({known.model.centre(), known.model.diameter});
}

std::vector<int> ObjectTracker::update(const std::vector<ObjectEstimate>& objects, double stamp) {
  const auto lost = [&](const Track& track) { return !alive(track, stamp); };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), lost), tracks_.end());

  std::vector<std::tuple<double, size_t, size_t>> pairs;  // distance, track, object
  for (size_t t = 0; t < tracks_.size(); ++t)
    for (size_t i = 0; i < objects.size(); ++i) {
      if (objects[i].object != tracks_[t].object.object) continue;
      const Shape& shape = shapes_.at(size_t(objects[i].object));
      const Rigid3& before = tracks_[t].object.camera_from_object;
      const Rigid3& now = objects[i].camera_from_object;
      const double reach = shape.diameter / 2 + options_.speed * (stamp - tracks_[t].stamp);
      if (samePlace(shape.centre, before, now, reach))
        pairs.emplace_back(distance(objects[i], tracks_[t].object), t, i);
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

std::vector<ObjectEstimate> ObjectTracker::previous(double stamp) const {
  std::vector<ObjectEstimate> objects;
  for (const Track& track : tracks_)
    if (alive(track, stamp)) objects.push_back(track.object);
  return objects;
}

bool ObjectTracker::alive(const Track& track, double stamp) const {
  return stamp >= track.stamp && stamp - track.stamp <= options_.forget_after;
}

double ObjectTracker::distance(const ObjectEstimate& a, const ObjectEstimate& b) const {
  const Eigen::Vector3d& centre = shapes_.at(size_t(a.object)).centre;
  return centreOffset(centre, a.camera_from_object, b.camera_from_object).norm();
}

int ObjectTracker::freeNumber(int object) const {
  int number = 0;
  const auto used = [&](const Track& track) {
    return track.object.object == object && track.number == number;
  };
  while (std::any_of(tracks_.begin(), tracks_.end(), used)) ++number;
  return number;
}

}  // namespace monocular_eye_hand
