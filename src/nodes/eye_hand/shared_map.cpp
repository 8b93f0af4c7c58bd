#include "nodes/eye_hand/shared_map.h"

#include "nodes/common/stamps.h"
#include "nodes/eye_hand/conversion.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRestart = 1.0;  // stamps that go back by more begin again [s]

}  // namespace

SharedMap::SharedMap(const ModelBase& models, const ObjectMapOptions& options, const std::string& base_frame)
    : models_(models), base_frame_(base_frame), map_(&models, options) {}

double SharedMap::beginAgain(const ros::Time& stamp) {
  std::lock_guard<std::mutex> lock(mutex_);
  const double went_back = secondsBetween(stamp, newest_);
  if (went_back <= kRestart) return 0;
  clearAll();
  return went_back;
}

SharedMap::Added SharedMap::add(const ObjectView& view, const ros::Time& stamp) {
  std::lock_guard<std::mutex> lock(mutex_);
  Added added;
  ViewReport& report = added.report;
  added.before_forget = stamp < not_before_;
  if (added.before_forget)
    report.refused = "the view is older than the last ~forget";
  else
    report = map_.add(view);
  refused_ = report.refused;
  if (!report.refused.empty()) return added;

  stamp_ = newest_ = stamp;
  table_height_ = view.known.table_height;
  ruled_out_ = ruledOut(report);
  std::map<std::pair<int, int>, ros::Time> stamps;
  for (const MappedObject& object : map_.objects()) {
    const std::pair<int, int> key(object.object, object.number);
    const auto known = stamps_.find(key);
    if (object.last_stamp == view.stamp)
      stamps[key] = stamp;
    else  // what had yielded to another one until now has none
      stamps[key] = known != stamps_.end() ? known->second : ros::Time(object.last_stamp);
  }
  stamps_ = std::move(stamps);
  return added;
}

std::vector<std::string> SharedMap::ruledOut(const ViewReport& report) const {
  std::vector<std::string> texts;
  for (const ViewDecision& decision : report.decisions)
    if (decision.impossible)
      texts.push_back(models_.objects.at(size_t(decision.object)).model.name + ": " + decision.reason);
  return texts;
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
  known.ruled_out = ruled_out_;
  known.table_height = table_height_;
  return known;
}

int SharedMap::forget(int object, int instance, const ros::Time& now) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (object < 0) {
    const int all = int(map_.objects().size());
    map_.clear();  // the stamps of views may start again, too
    not_before_ = newest_ = ros::Time();
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
  clearAll();
}

void SharedMap::clearAll() {
  map_.clear();
  stamps_.clear();
  ruled_out_.clear();
  stamp_ = newest_ = not_before_ = ros::Time();
}

}  // namespace monocular_eye_hand
