#include "gui/model/errand_thread.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace pilothouse::gui {

namespace {
constexpr std::size_t kMost = 16;  // a hanging robot must not gather them without end
constexpr auto kPatience = std::chrono::milliseconds(300);
struct Errand {
  std::string what;
  ErrandThread::Work work;
};
}  // namespace

struct ErrandThread::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Errand> waiting;
  std::optional<Errand> idle;
  std::function<void(const std::string&)> under_way;
  bool ending = false, ended = false;
};

ErrandThread::ErrandThread(std::function<void(const std::string&)> under_way)
    : shared_(std::make_shared<Shared>()) {
  shared_->under_way = std::move(under_way);
  std::thread([shared = shared_] { run(shared); }).detach();
}

ErrandThread::~ErrandThread() {
  std::unique_lock<std::mutex> lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kPatience, [&] { return shared_->ended; });
}

bool ErrandThread::add(const std::string& what, Work work) {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  if (shared_->waiting.size() >= kMost) return false;
  shared_->waiting.push_back({what, std::move(work)});
  shared_->changed.notify_all();
  return true;
}

void ErrandThread::addIdle(const std::string& what, Work work) {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  shared_->idle = Errand{what, std::move(work)};
  shared_->changed.notify_all();
}

void ErrandThread::forget() {
  std::deque<Errand> dropped;  // destroyed outside the lock: an errand may hold anything
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  dropped.swap(shared_->waiting);
}

void ErrandThread::run(const std::shared_ptr<Shared>& shared) {
  std::unique_lock<std::mutex> lock(shared->mutex);
  for (;;) {
    shared->changed.wait(
        lock, [&] { return shared->ending || !shared->waiting.empty() || shared->idle; });
    if (shared->ending) break;
    Errand errand;
    if (!shared->waiting.empty()) {
      errand = std::move(shared->waiting.front());
      shared->waiting.pop_front();
    } else {
      errand = std::move(*shared->idle);
      shared->idle.reset();
    }
    lock.unlock();
    shared->under_way(errand.what);
    errand.work();
    shared->under_way({});
    lock.lock();
  }
  shared->ended = true;
  shared->changed.notify_all();
}

}  // namespace pilothouse::gui
