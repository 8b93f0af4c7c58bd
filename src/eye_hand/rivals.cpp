// Two solid things are never in one place: of those that a map holds there, which is published.
#include <algorithm>
#include <tuple>

#include "monocular_eye_hand/eye_hand/object_map.h"
#include "monocular_eye_hand/model/interior.h"

namespace monocular_eye_hand {

const std::vector<Eigen::Vector3d>& ObjectMap::core(int object) {
  auto found = cores_.find(object);
  if (found == cores_.end())
    found = cores_.emplace(object, innerPoints(model(object), options_.overlap_depth)).first;
  return found->second;
}

bool ObjectMap::inOnePlace(const Track& a, const Track& b) {
  const Rigid3 a_from_b = a.merged.base_from_object.inverse() * b.merged.base_from_object;
  const int i = a.object.object, j = b.object.object;
  return interpenetrate(model(i), core(i), model(j), core(j), a_from_b);
}

void ObjectMap::findRivals() {
  for (Track& track : tracks_) track.rivals.clear();
  for (size_t i = 0; i < tracks_.size(); ++i)
    for (size_t j = i + 1; j < tracks_.size(); ++j)
      if (inOnePlace(tracks_[i], tracks_[j])) {
        tracks_[i].rivals.push_back(tracks_[j].key());
        tracks_[j].rivals.push_back(tracks_[i].key());
      }
}

void ObjectMap::resolveConflicts() {
  std::vector<Track*> ranked;  // a doubt suppresses nothing
  for (Track& track : tracks_)
    if (track.believed) ranked.push_back(&track);
  // What things lie in is suppressed by none of them.
  const auto rank = [this](const Track* track) {
    const MappedObject& o = track->object;
    const bool obstacle = models_->objects[size_t(o.object)].handling.obstacle;
    return std::make_tuple(!obstacle, track->missed - o.views, o.misses, -o.last_stamp,
                           -track->merged.probability);
  };
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&](const Track* a, const Track* b) { return rank(a) < rank(b); });

  std::vector<Key> published;
  for (Track* track : ranked) {
    const auto better =
        std::find_first_of(published.begin(), published.end(), track->rivals.begin(), track->rivals.end());
    track->suppressed_by.reset();
    if (better != published.end())
      track->suppressed_by = *better;
    else
      published.push_back(track->key());
  }
}

}  // namespace monocular_eye_hand
