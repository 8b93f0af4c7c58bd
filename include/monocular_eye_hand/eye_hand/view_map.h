#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/eye_hand/object_map.h"

namespace monocular_eye_hand {

/// What is known after some view.
struct MapState {
  std::vector<MappedObject> objects;
  std::optional<double> stamp;         ///< of the last view that was used [s]; none: no view was
  std::string refused;                 ///< why the last view was not used; "": it was
  std::vector<std::string> ruled_out;  ///< what the last used view showed where nothing can be, with reasons
  std::optional<double> table_height;  ///< z of the table's top in base, as the last view had it [m]
};

/// What became of a view.
struct AddedView {
  ViewReport report;
  bool before_forget = false;  ///< refused, as it should be
};

/// The object map over time: which views count, and what was last heard.
class ViewMap {
 public:
  /// Keeps a pointer to `models`. Throws BadInput when an option is out of range.
  ViewMap(const ModelBase* models, const ObjectMapOptions& options);

  /// A view whose stamp is more than a second before the last one's begins a new map: a bag is played again,
  /// or somebody set a clock. Returns how far the stamps went back [s]; 0: they did not.
  double beginAgain(double stamp);
  /// Throws BadInput as ObjectMap::add. A view from before the last forget() is left out.
  AddedView add(const ObjectView& view);
  /// A view that never came to the map.
  void refuse(const std::string& reason) { state_.refused = reason; }
  const MapState& state() const { return state_; }

  /// Takes objects out and returns how many: all of a name with `number` -1; with `object` -1 everything,
  /// numbers and the stamp that the next view must be newer than, too. Views from before `now` [s] are
  /// refused from then on: they would bring back what was carried away.
  int forget(int object, int number, double now);
  /// Time starts again.
  void clear();

 private:
  int forgetAll();

  const ModelBase* models_;
  ObjectMap map_;
  MapState state_;
  std::optional<double> newest_;  // the next view must not be much older; none: any may come
  std::optional<double> not_before_;
};

}  // namespace monocular_eye_hand
