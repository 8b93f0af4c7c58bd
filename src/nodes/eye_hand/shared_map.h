#pragma once
#include <monocular_eye_hand/LocatedObjectArray.h>
#include <ros/time.h>

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/eye_hand/object_map.h"

namespace monocular_eye_hand {

/// What is known after some view: the objects as the core and as messages tell them, in the same order.
struct KnownObjects {
  std::vector<MappedObject> objects;
  std::vector<LocatedObject> messages;
  ros::Time stamp;                     ///< of the last view that was used; zero: none
  std::string refused;                 ///< why the last view was not used; "": it was
  std::vector<std::string> ruled_out;  ///< what the last used view showed where nothing can be, with reasons
  std::optional<double> table_height;  ///< z of the table's top in base, as the last view had it [m]
};

/// The object map, safe from several threads, with the stamps as ROS spells them.
class SharedMap {
 public:
  /// `models` must outlive it.
  SharedMap(const ModelBase& models, const ObjectMapOptions& options, const std::string& base_frame);
  /// A view whose stamp is more than a second before the last one's begins a new map: a bag is played again,
  /// or somebody set a clock. Returns how far the stamps went back [s]; 0: they did not.
  double beginAgain(const ros::Time& stamp);
  /// Throws BadInput as ObjectMap::add. A view from before the last ~forget is left out.
  struct Added {
    ViewReport report;
    bool before_forget = false;  ///< refused, as it should be
  };
  Added add(const ObjectView& view, const ros::Time& stamp);
  /// A view that never came to the map.
  void refuse(const std::string& reason);
  KnownObjects known() const;
  /// Takes objects out and returns how many: all of a name with `instance` -1; with `object` -1 everything,
  /// numbers and the stamp that the next view must be newer than, too. Views from before `now` are refused
  /// from then on: they would bring back what was carried away.
  int forget(int object, int instance, const ros::Time& now);
  /// Time starts again.
  void clear();

 private:
  void clearAll();  // with mutex_ held
  std::vector<std::string> ruledOut(const ViewReport& report) const;

  const ModelBase& models_;
  const std::string base_frame_;
  mutable std::mutex mutex_;
  ObjectMap map_;
  std::map<std::pair<int, int>, ros::Time> stamps_;  // of object and number: the last view
  ros::Time stamp_;
  ros::Time newest_;  // the next view must not be much older; zero: any may come
  ros::Time not_before_;
  std::string refused_;
  std::vector<std::string> ruled_out_;
  std::optional<double> table_height_;
};

}  // namespace monocular_eye_hand
