#include "monocular_eye_hand/eye_hand/view_map.h"

#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {
namespace {

std::vector<std::string> ruledOut(const ViewReport& report, const ModelBase& models) {
  std::vector<std::string> texts;
  for (const ViewDecision& decision : report.decisions)
    if (decision.impossible)
      texts.push_back(models.objects.at(size_t(decision.object)).model.name + ": " + decision.reason);
  return texts;
}

}  // namespace

ViewMap::ViewMap(const ModelBase* models, const ObjectMapOptions& options)
    : models_(models), map_(models, options) {}

double ViewMap::beginAgain(double stamp) {
  if (!newest_ || *newest_ - stamp <= kTimeRestart) return 0;
  const double went_back = *newest_ - stamp;
  clear();
  return went_back;
}

AddedView ViewMap::add(const ObjectView& view) {
  AddedView added;
  added.before_forget = not_before_ && view.stamp < *not_before_;
  if (added.before_forget)
    added.report.refused = "the view is older than the last ~forget";
  else
    added.report = map_.add(view);
  state_.refused = added.report.refused;
  if (!added.report.refused.empty()) return added;

  state_.objects = map_.objects();
  state_.stamp = newest_ = view.stamp;
  state_.table_height = view.known.table_height;
  state_.ruled_out = ruledOut(added.report, *models_);
  return added;
}

int ViewMap::forget(int object, int number, double now) {
  if (object < 0) return forgetAll();
  int forgotten = 0;
  for (const MappedObject& known : map_.objects())
    if (known.object == object && (number < 0 || known.number == number))
      forgotten += map_.forget(known.object, known.number);

  if (forgotten > 0) not_before_ = now;
  state_.objects = map_.objects();
  return forgotten;
}

int ViewMap::forgetAll() {
  const int all = int(map_.objects().size());
  map_.clear();  // the stamps of views may start again, too
  state_.objects.clear();
  not_before_.reset();
  newest_.reset();
  return all;
}

void ViewMap::clear() {
  map_.clear();
  state_.objects.clear();
  state_.ruled_out.clear();
  state_.stamp.reset();
  not_before_.reset();
  newest_.reset();
}

}  // namespace monocular_eye_hand
