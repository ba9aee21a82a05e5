#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloud/checked.hpp"
#include "core/cloud/message_bounds.hpp"

namespace pilothouse {

/// Largest lengths that a message of any type may claim.
struct WireBounds {
  std::size_t max_text = std::size_t{1} << 16;      ///< bytes of a text
  std::size_t max_bytes = std::size_t{1} << 28;     ///< entries of an array of single bytes
  std::size_t max_elements = std::size_t{1} << 24;  ///< entries of any other array
};

/// Where the lengths lie in a serialised message, read from the text of its definition. So the
/// guard of message_bounds.hpp holds for every type of message, with looser bounds.
class WireSchema {
 public:
  /// @param type "package/Name" of the first message in the text.
  /// @param definition as roscpp has it: the message, then behind lines of = and "MSG:
  /// package/Name"
  ///   all others that it is made of. Refused where one is missing, is made of itself, or cannot be
  ///   read; the reason names the line.
  static Checked<WireSchema> parse(std::string_view type, std::string_view definition);

  /// The first length prefix that does not fit the bytes or the bounds; nothing when the message
  /// may be deserialised. Neither allocates nor reads outside [bytes, bytes + size). The fault's
  /// name lives as long as this object stays where it is.
  std::optional<LengthFault> fault(const std::uint8_t* bytes, std::size_t size,
                                   const WireBounds& bounds = {}) const;

  struct Field {
    enum class Count { kOne, kFixed, kPrefixed };
    std::string name;
    bool text = false;
    int type = -1;           ///< index of a message whose length varies; -1: text, or fixed bytes
    std::uint64_t size = 0;  ///< bytes of one element; of text and messages the least
    Count count = Count::kOne;
    std::uint64_t times = 1;  ///< of kFixed
  };
  struct Type {
    std::string name;
    std::vector<Field> fields;
    bool varies = false;      ///< its length depends on what it holds
    std::uint64_t least = 0;  ///< bytes
  };
  /// Every message after those that it is made of: the last is the whole.
  const std::vector<Type>& types() const { return types_; }

 private:
  std::vector<Type> types_;
};

}  // namespace pilothouse
