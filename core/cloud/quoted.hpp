#pragma once

#include <string>
#include <string_view>

namespace pilothouse {

/// Text from outside, fit for a message of ours: in quotation marks, short and printable.
inline std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 32;
  std::string out(text.substr(0, kMost));
  for (char& c : out)
    if (c < 0x20 || c > 0x7E) c = '?';
  return "\"" + out + (text.size() > kMost ? "...\"" : "\"");
}

}  // namespace pilothouse
