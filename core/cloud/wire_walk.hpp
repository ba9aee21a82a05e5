#pragma once

#include <algorithm>
#include <optional>

#include "core/cloud/message_bounds.hpp"

namespace pilothouse {

/// Walks over a serialised message (ROS 1 wire format, little endian) and never leaves its bytes.
/// After the first fault every further step does nothing.
class WireWalk {
 public:
  WireWalk(const std::uint8_t* bytes, std::size_t size)
      : next_(bytes), left_(bytes == nullptr ? 0 : size) {}

  /// @param thing what the bytes belong to; must outlive the fault.
  void skip(std::uint64_t count, const char* thing) {
    if (fault_) return;
    if (count > left_) {
      fault_ = LengthFault{thing, count, left_};
      return;
    }
    next_ += count;
    left_ -= static_cast<std::size_t>(count);
  }

  std::uint32_t length(const char* thing) {
    const std::uint8_t* at = next_;
    skip(4, thing);
    if (fault_) return 0;
    return static_cast<std::uint32_t>(at[0]) | static_cast<std::uint32_t>(at[1]) << 8U |
           static_cast<std::uint32_t>(at[2]) << 16U | static_cast<std::uint32_t>(at[3]) << 24U;
  }

  /// A length prefix and as many elements, each at least `element` (1 or more) bytes. Leaves the
  /// elements to the caller.
  std::uint32_t count(const char* thing, std::uint64_t most, std::uint64_t element) {
    const std::uint32_t claimed = length(thing);
    if (fault_) return 0;
    const std::uint64_t limit = std::min<std::uint64_t>(most, left_ / element);
    if (claimed <= limit) return claimed;
    fault_ = LengthFault{thing, claimed, limit};
    return 0;
  }

  void array(const char* thing, std::uint64_t most, std::uint64_t element) {
    skip(count(thing, most, element) * element, thing);
  }

  void header(const MessageBounds& bounds) {
    skip(12, "header");  // seq, stamp
    array("frame_id", bounds.max_text, 1);
  }

  void refuse(const LengthFault& fault) {
    if (!fault_) fault_ = fault;
  }
  bool stopped() const { return fault_.has_value(); }

  std::optional<LengthFault> end() {
    if (!fault_ && left_ > 0) fault_ = LengthFault{"bytes after the message", left_, 0};
    return fault_;
  }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
  std::optional<LengthFault> fault_;
};

}  // namespace pilothouse
