#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace pilothouse {

/// Calls something again and again in a thread of its own, until it is destroyed. What takes its
/// time does not belong into a nodelet's callbacks: a nodelet that is unloaded while one of them
/// runs is destroyed after its queues, which roscpp's timers do not survive.
class SteadyLoop {
 public:
  /// @param period from the end of a call to the next [s].
  SteadyLoop(double period, std::function<void()> work)
      : thread_([this, period, work = std::move(work)] {
          std::unique_lock<std::mutex> lock(mutex_);
          const std::chrono::duration<double> pause(period);
          while (!wake_.wait_for(lock, pause, [this] { return ending_; })) {
            lock.unlock();
            work();
            lock.lock();
          }
        }) {}
  ~SteadyLoop() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  SteadyLoop(const SteadyLoop&) = delete;
  SteadyLoop& operator=(const SteadyLoop&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace pilothouse
