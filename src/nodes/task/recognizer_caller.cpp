#include "nodes/task/recognizer_caller.h"

#include <monocular_eye_hand/Recognize.h>

#include <chrono>

#include "nodes/common/names.h"
#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr std::chrono::milliseconds kSlowTopic(200);     // the objects may come so much later than the answer
constexpr std::chrono::milliseconds kSlowEyeHand(1000);  // ... and their view after them
constexpr double kGone = 3.0;  // a recogniser that is not there for so long is told [s]

std::string complaintOf(const RecognizeResponse& response) {
  const bool worked =
      response.status == RecognizeResponse::FOUND || response.status == RecognizeResponse::NOT_FOUND;
  return worked ? "" : response.text;
}

}  // namespace

RecognizerCaller::RecognizerCaller() {
  recognized_subscriber_ =
      node_.subscribe(names::kRecognizedObjects, 10, &RecognizerCaller::onRecognized, this);
  service_ = node_.serviceClient<Recognize>(names::kAskRecognizer);
  thread_ = std::thread(&RecognizerCaller::work, this);
}

RecognizerCaller::~RecognizerCaller() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RecognizerCaller::ask(const std::optional<ros::Time>& after) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ask_after_ = after;
  absent_ = false;
  complaint_.clear();
  changed_.notify_all();
}

bool RecognizerCaller::gone() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return goneNow();
}

bool RecognizerCaller::goneNow() const {
  const bool silent = recognized_at_.never() || recognized_at_.since() >= kGone;
  return absent_ && silent && absent_since_.since() >= kGone;
}

void RecognizerCaller::describe(EyeChain* chain) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  chain->recognizer_call = node_.resolveName(names::kAskRecognizer);
  chain->recognized = recognized_subscriber_.getTopic();
  chain->recognizer_gone = goneNow();
  chain->tells_recognized = recognized_subscriber_.getNumPublishers() > 0;
  chain->last_recognized = recognized_.toSec();
  chain->complaint = complaint_;
}

void RecognizerCaller::forgetAfter(const ros::Time& latest) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (recognized_ > latest) recognized_ = ros::Time();
}

void RecognizerCaller::onRecognized(const RecognizedObjectArray& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  recognized_ = message.header.stamp;
  recognized_at_ = Moment::now();
  changed_.notify_all();
}

void RecognizerCaller::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto wanted = [this] { return ending_ || ask_after_; };
  const auto enough = [this] { return ending_ || !ask_after_; };

  while (true) {
    changed_.wait(lock, wanted);
    if (ending_) return;
    const ros::Time after = *ask_after_;
    lock.unlock();
    Recognize call;
    const bool there = service_.exists();
    const bool answered = there && service_.call(call);
    lock.lock();

    if (there)
      absent_since_ = Moment();
    else if (absent_since_.never())
      absent_since_ = Moment::now();
    absent_ = !there && ask_after_;
    complaint_ = answered ? complaintOf(call.response) : "";

    const auto recognized = [&] { return enough() || recognized_ >= after; };
    if (!answered)
      changed_.wait_for(lock, kSlowTopic, enough);
    else if (changed_.wait_for(lock, kSlowTopic, recognized) && !enough())
      changed_.wait_for(lock, kSlowEyeHand, enough);
  }
}

}  // namespace monocular_eye_hand
