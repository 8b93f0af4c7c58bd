#pragma once
#include <monocular_eye_hand/LocatedObjectArray.h>
#include <ros/time.h>

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/eye_hand/view_map.h"

namespace monocular_eye_hand {

/// What is known after some view, and its objects as messages tell them, in the same order.
struct KnownObjects {
  MapState map;
  std::vector<LocatedObject> messages;
  ros::Time stamp;  ///< MapState::stamp as ROS spells it; zero: none
};

/// The object map, safe from several threads, with the stamps as ROS spells them.
class SharedMap {
 public:
  /// `models` must outlive it.
  SharedMap(const ModelBase& models, const ObjectMapOptions& options, const std::string& base_frame);
  /// As the functions of ViewMap.
  double beginAgain(const ros::Time& stamp);
  AddedView add(const ObjectView& view, const ros::Time& stamp);
  void refuse(const std::string& reason);
  int forget(int object, int number, const ros::Time& now);
  void clear();
  KnownObjects known() const;

 private:
  void takeStamp(const ros::Time& stamp, double seconds);  // with mutex_ held

  const std::string base_frame_;
  mutable std::mutex mutex_;
  ViewMap map_;
  std::map<std::pair<int, int>, ros::Time> stamps_;  // of object and number: the last view
  ros::Time stamp_;
};

}  // namespace monocular_eye_hand
