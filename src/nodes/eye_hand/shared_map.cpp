#include "nodes/eye_hand/shared_map.h"

#include "nodes/eye_hand/conversion.h"

namespace monocular_eye_hand {

SharedMap::SharedMap(const ModelBase& models, const ObjectMapOptions& options, const std::string& base_frame)
    : base_frame_(base_frame), map_(&models, options) {}

double SharedMap::beginAgain(const ros::Time& stamp) {
  std::lock_guard<std::mutex> lock(mutex_);
  const double went_back = map_.beginAgain(stamp.toSec());
  if (went_back > 0) stamps_.clear();
  return went_back;
}

AddedView SharedMap::add(const ObjectView& view, const ros::Time& stamp) {
  std::lock_guard<std::mutex> lock(mutex_);
  const AddedView added = map_.add(view);
  if (added.report.refused.empty()) takeStamp(stamp, view.stamp);
  return added;
}

/// Seconds as a double are coarser than the stamps that others look for in tf.
void SharedMap::takeStamp(const ros::Time& stamp, double seconds) {
  stamp_ = stamp;
  std::map<std::pair<int, int>, ros::Time> stamps;
  for (const MappedObject& object : map_.state().objects) {
    const std::pair<int, int> key(object.object, object.number);
    const auto known = stamps_.find(key);
    if (object.last_stamp == seconds)
      stamps[key] = stamp;
    else  // what had yielded to another one until now has none
      stamps[key] = known != stamps_.end() ? known->second : ros::Time(object.last_stamp);
  }
  stamps_ = std::move(stamps);
}

void SharedMap::refuse(const std::string& reason) {
  std::lock_guard<std::mutex> lock(mutex_);
  map_.refuse(reason);
}

KnownObjects SharedMap::known() const {
  std::lock_guard<std::mutex> lock(mutex_);
  KnownObjects known;
  known.map = map_.state();
  for (const MappedObject& object : known.map.objects)
    known.messages.push_back(toMessage(object, stamps_.at({object.object, object.number}), base_frame_));
  if (known.map.stamp) known.stamp = stamp_;
  return known;
}

int SharedMap::forget(int object, int number, const ros::Time& now) {
  std::lock_guard<std::mutex> lock(mutex_);
  return map_.forget(object, number, now.toSec());
}

void SharedMap::clear() {
  std::lock_guard<std::mutex> lock(mutex_);
  map_.clear();
  stamps_.clear();
}

}  // namespace monocular_eye_hand
