#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

namespace pilothouse {

struct FuzzBytes {
  std::uint8_t* data() const { return memory.get() + shift; }

  std::unique_ptr<std::uint8_t[]> memory;
  std::size_t shift = 0;
};

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
  /// What is left, in memory that ends with it: ASan sees any step beyond.
  /// @param shift bytes by which it misses its natural alignment.
  FuzzBytes rest(std::size_t shift = 0) const {
    FuzzBytes copy{std::make_unique<std::uint8_t[]>(shift + left_), shift};
    if (left_ > 0) std::memcpy(copy.data(), next_, left_);
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
