#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace pilothouse {

/// Frames that were read once and are played again: kept as long as all of them together stay
/// within a budget, read again otherwise. A player thus holds the budget and one frame at most.
template <class Frame>
class FrameCache {
 public:
  using Pointer = std::shared_ptr<const Frame>;

  explicit FrameCache(std::size_t budget_bytes = std::size_t{1} << 28) : left_(budget_bytes) {}
  void resize(std::size_t frames) { frames_.resize(frames); }

  /// @param read returns the frame, or throws. @param bytes tells how large it is.
  template <class Read, class Bytes>
  Pointer get(std::size_t index, Read read, Bytes bytes) {
    if (frames_[index]) return frames_[index];
    auto frame = std::make_shared<const Frame>(read());
    const std::size_t size = bytes(*frame);
    if (size <= left_) {
      left_ -= size;
      frames_[index] = frame;
    }
    return frame;
  }

 private:
  std::vector<Pointer> frames_;
  std::size_t left_;
};

}  // namespace pilothouse
