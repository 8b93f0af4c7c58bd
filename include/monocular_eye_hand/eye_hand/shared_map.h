#pragma once
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/eye_hand/view_map.h"
#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

/// What is known after some view, with its stamps to the nanosecond: seconds as a double are coarser than the
/// stamps that others look for.
struct KnownObjects {
  MapState map;
  std::vector<Nanoseconds> stamps;  ///< of the last view of each of map.objects
  Nanoseconds stamp = 0;            ///< that is MapState::stamp; 0: none
};

/// The object map, safe from several threads.
class SharedMap {
 public:
  /// Keeps a pointer to `models`. Throws BadInput when an option is out of range.
  SharedMap(const ModelBase* models, const ObjectMapOptions& options);
  /// As the functions of ViewMap.
  double beginAgain(Nanoseconds stamp);
  AddedView add(const ObjectView& view, Nanoseconds stamp);
  void refuse(const std::string& reason);
  int forget(int object, int number, Nanoseconds now);
  void clear();
  KnownObjects known() const;

 private:
  using Key = std::pair<int, int>;  // MappedObject::object, number

  void takeStamp(Nanoseconds stamp, double seconds);  // with mutex_ held

  mutable std::mutex mutex_;
  ViewMap map_;
  std::map<Key, Nanoseconds> stamps_;  // of the last view
  Nanoseconds stamp_ = 0;
};

}  // namespace monocular_eye_hand
