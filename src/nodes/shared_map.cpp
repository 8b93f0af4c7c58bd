#include "nodes/shared_map.h"

#include "nodes/eye_hand_conversion.h"

namespace monocular_eye_hand {

SharedMap::SharedMap(const ModelBase& models, const ObjectMapOptions& options, const std::string& base_frame)
    : base_frame_(base_frame), map_(&models, options) {}

ViewReport SharedMap::add(const ObjectView& view, const ros::Time& stamp) {
  std::lock_guard<std::mutex> lock(mutex_);
  ViewReport report;
  if (stamp < not_before_)
    report.refused = "the view is older than the last ~forget";
  else
    report = map_.add(view);
  refused_ = report.refused;
  if (!report.refused.empty()) return report;
  stamp_ = stamp;
  std::map<std::pair<int, int>, ros::Time> stamps;
  for (const MappedObject& object : map_.objects()) {
    const std::pair<int, int> key(object.object, object.number);
    stamps[key] = object.last_stamp == view.stamp ? stamp : stamps_[key];
  }
  stamps_ = std::move(stamps);
  return report;
}

void SharedMap::refuse(const std::string& reason) {
  std::lock_guard<std::mutex> lock(mutex_);
  refused_ = reason;
}

KnownObjects SharedMap::known() const {
  std::lock_guard<std::mutex> lock(mutex_);
  KnownObjects known;
  known.objects = map_.objects();
  for (const MappedObject& object : known.objects)
    known.messages.push_back(toMessage(object, stamps_.at({object.object, object.number}), base_frame_));
  known.stamp = stamp_;
  known.refused = refused_;
  return known;
}

int SharedMap::forget(int object, int instance, const ros::Time& now) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (object < 0) {
    const int all = int(map_.objects().size());
    map_.clear();  // the stamps of views may start again, too
    not_before_ = ros::Time();
    return all;
  }
  int forgotten = 0;
  for (const MappedObject& known : map_.objects())
    if (known.object == object && (instance < 0 || known.number == instance))
      forgotten += map_.forget(known.object, known.number);
  if (forgotten > 0) not_before_ = now;
  return forgotten;
}

void SharedMap::clear() {
  std::lock_guard<std::mutex> lock(mutex_);
  map_.clear();
  stamps_.clear();
  stamp_ = not_before_ = ros::Time();
}

}  // namespace monocular_eye_hand
