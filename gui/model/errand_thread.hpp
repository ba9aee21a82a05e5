#pragma once

#include <functional>
#include <memory>
#include <string>

namespace pilothouse::gui {

/// Does one thing after the other on a thread of its own, in order. Whoever ends it waits a short
/// while only: a thing that hangs keeps its thread, which ends when the thing does.
class ErrandThread {
 public:
  using Work = std::function<void()>;
  /// @param under_way told before each thing (its name) and after it (empty), on the thread.
  explicit ErrandThread(std::function<void(const std::string&)> under_way);
  ~ErrandThread();
  ErrandThread(const ErrandThread&) = delete;
  ErrandThread& operator=(const ErrandThread&) = delete;

  /// @return false: too many wait already.
  bool add(const std::string& what, Work work);
  /// The same, in place of one that was added so and has not begun; done when nothing else waits.
  void addIdle(const std::string& what, Work work);
  /// Drops what was added and has not begun.
  void forget();

 private:
  struct Shared;
  static void run(const std::shared_ptr<Shared>& shared);
  std::shared_ptr<Shared> shared_;
};

}  // namespace pilothouse::gui
