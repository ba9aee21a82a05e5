#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

namespace pilothouse {

/// Reads a fuzz input from its front; numbers are zero once it has ended.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* bytes, std::size_t size) : next_(bytes), left_(size) {}

  template <class T>
  T take() {
    T value{};
    const std::size_t count = left_ < sizeof(T) ? left_ : sizeof(T);
    if (count > 0) std::memcpy(&value, next_, count);
    next_ += count;
    left_ -= count;
    return value;
  }
  std::size_t left() const { return left_; }
  /// What is left, in memory of exactly that size: ASan sees any step beyond it.
  std::unique_ptr<std::uint8_t[]> rest() const {
    auto copy = std::make_unique<std::uint8_t[]>(left_);
    if (left_ > 0) std::memcpy(copy.get(), next_, left_);
    return copy;
  }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
};

/// Ends the run with a crash that libFuzzer keeps.
inline void require(bool holds) {
  if (!holds) __builtin_trap();
}

}  // namespace pilothouse
