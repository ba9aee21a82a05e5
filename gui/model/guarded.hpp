#pragma once

#include <mutex>
#include <utility>

namespace pilothouse::gui {

/// A value written by one thread and read by others.
template <class T>
class Guarded {
 public:
  void set(T value) { exchange(std::move(value)); }
  /// @return what it was: destroyed outside the lock, whatever that takes.
  T exchange(T value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(value_, value);
    return value;
  }
  T get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return value_;
  }
  /// Changes it in place; `change` must be short.
  template <class Change>
  void update(Change&& change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    change(value_);
  }

 private:
  mutable std::mutex mutex_;
  T value_{};
};

}  // namespace pilothouse::gui
