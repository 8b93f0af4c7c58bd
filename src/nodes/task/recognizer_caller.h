#pragma once
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/ros.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "monocular_eye_hand/task/eye_chain.h"
#include "nodes/common/moment.h"

namespace monocular_eye_hand {

/// Asks the recogniser for an image. One that works on request does so now; one that works on every image
/// answers with the next. A thread of its own: a recogniser that hangs does not answer for ever.
class RecognizerCaller {
 public:
  RecognizerCaller();
  ~RecognizerCaller();

  /// For an image from `after` on; again when the answer is of an image that was on its way before, and when
  /// eye_hand makes no use of it, until called with none.
  void ask(const std::optional<ros::Time>& after);
  /// Its service is not there, and for as long nothing came from it.
  bool gone() const;
  /// Sets what concerns the recogniser.
  void describe(EyeChain* chain) const;
  /// Time went back: an image from later than `latest` does not count any more.
  void forgetAfter(const ros::Time& latest);

 private:
  void onRecognized(const RecognizedObjectArray& message);
  void work();
  bool goneNow() const;  // with mutex_ held

  ros::NodeHandle node_;
  ros::ServiceClient service_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<ros::Time> ask_after_;  // an image from then on is wanted
  bool absent_ = false;                 // its service is not there, by the last call for this image
  Moment absent_since_;
  std::string complaint_;  // why it could not work on the last image asked for; "": it could
  ros::Time recognized_;   // stamp of the last image that it worked on
  Moment recognized_at_;
  bool ending_ = false;
  ros::Subscriber recognized_subscriber_;
  std::thread thread_;
};

}  // namespace monocular_eye_hand
