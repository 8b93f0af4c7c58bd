#include "monocular_eye_hand/eye_hand/shared_map.h"

namespace monocular_eye_hand {

SharedMap::SharedMap(const ModelBase* models, const ObjectMapOptions& options) : map_(models, options) {}

double SharedMap::beginAgain(Nanoseconds stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double went_back = map_.beginAgain(secondsOf(stamp));
  if (went_back > 0) stamps_.clear();
  return went_back;
}

AddedView SharedMap::add(const ObjectView& view, Nanoseconds stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const AddedView added = map_.add(view);
  if (added.report.refused.empty()) takeStamp(stamp, view.stamp);
  return added;
}

void SharedMap::takeStamp(Nanoseconds stamp, double seconds) {
  stamp_ = stamp;
  std::map<Key, Nanoseconds> stamps;
  for (const MappedObject& object : map_.state().objects) {
    const Key key(object.object, object.number);
    const auto known = stamps_.find(key);
    if (object.last_stamp == seconds)
      stamps[key] = stamp;
    else  // what was suppressed until now has none
      stamps[key] = known != stamps_.end() ? known->second : nanosecondsOf(object.last_stamp);
  }
  stamps_ = std::move(stamps);
}

void SharedMap::refuse(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  map_.refuse(reason);
}

KnownObjects SharedMap::known() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  KnownObjects known;
  known.map = map_.state();
  for (const MappedObject& object : known.map.objects)
    known.stamps.push_back(stamps_.at({object.object, object.number}));
  if (known.map.stamp) known.stamp = stamp_;
  return known;
}

int SharedMap::forget(int object, int number, Nanoseconds now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return map_.forget(object, number, secondsOf(now));
}

void SharedMap::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  map_.clear();
  stamps_.clear();
}

}  // namespace monocular_eye_hand
