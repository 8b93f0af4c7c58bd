#pragma once
#include <monocular_eye_hand/Recognize.h>
#include <monocular_eye_hand/RecognizedObject.h>
#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// One call of ~recognize on its way through the node.
struct PendingRequest {
  std::string name;    ///< "" = all
  uint64_t after = 0;  ///< images up to this number came before the call
  bool taken = false;  ///< the worker has it
  bool answered = false;
  Recognize::Response reply;
};
using PendingRequestPtr = std::shared_ptr<PendingRequest>;

/// Calls that wait for the next image. The service threads wait here, the worker takes and answers.
class Requests {
 public:
  PendingRequestPtr add(const std::string& name, uint64_t after);
  /// Waits until the request is answered; false when it was not answered in `timeout` [s, wall clock] and
  /// nobody had taken it: it is then withdrawn. `arrived` tells whether an image for it has come, which the
  /// worker takes as soon as it is free: the wait then goes on.
  template <class Arrived>
  bool wait(const PendingRequestPtr& request, double timeout, Arrived arrived);
  /// The requests that image `number` answers, in the order of their arrival.
  std::vector<PendingRequestPtr> take(uint64_t number);
  void answer(const PendingRequestPtr& request, const Recognize::Response& reply);
  bool empty() const;
  /// Ends every wait: the node goes down.
  void close();

 private:
  bool waitFor(std::unique_lock<std::mutex>& lock, const PendingRequestPtr& request, double timeout);
  bool withdraw(const PendingRequestPtr& request);  // false when the worker has it

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<PendingRequestPtr> waiting_;
  bool closed_ = false;
};

template <class Arrived>
bool Requests::wait(const PendingRequestPtr& request, double timeout, Arrived arrived) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (waitFor(lock, request, timeout)) return true;
  while (!closed_ && (request->taken || arrived()))
    if (waitFor(lock, request, 0.1)) return true;
  return withdraw(request) ? false : request->answered;
}

}  // namespace monocular_eye_hand
