#include "nodes/recognizer/requests.h"

#include <chrono>

namespace monocular_eye_hand {

PendingRequestPtr Requests::add(const std::string& name, uint64_t after) {
  auto request = std::make_shared<PendingRequest>();
  request->name = name;
  request->after = after;
  std::lock_guard<std::mutex> lock(mutex_);
  waiting_.push_back(request);
  return request;
}

std::vector<PendingRequestPtr> Requests::take(uint64_t number) {
  std::lock_guard<std::mutex> lock(mutex_);
  std::vector<PendingRequestPtr> taken;
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    if ((*it)->after < number) {
      (*it)->taken = true;
      taken.push_back(*it);
      it = waiting_.erase(it);
    } else {
      ++it;
    }
  }
  return taken;
}

void Requests::answer(const PendingRequestPtr& request, const Recognize::Response& reply) {
  std::lock_guard<std::mutex> lock(mutex_);
  request->reply = reply;
  request->answered = true;
  changed_.notify_all();
}

bool Requests::empty() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.empty();
}

void Requests::close() {
  std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

bool Requests::waitFor(std::unique_lock<std::mutex>& lock, const PendingRequestPtr& request, double timeout) {
  changed_.wait_for(lock, std::chrono::duration<double>(timeout),
                    [&] { return request->answered || closed_; });
  return request->answered;
}

bool Requests::withdraw(const PendingRequestPtr& request) {
  if (request->taken) return false;
  waiting_.remove(request);
  return true;
}

}  // namespace monocular_eye_hand
