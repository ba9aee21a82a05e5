#pragma once

#include <array>
#include <cstddef>

namespace pilothouse::gui {

/// The symbols that X gives to a key in each of its groups (layouts); 0: none.
using KeySymbols = std::array<unsigned long, 4>;

/// What the key means while a group is active: its own symbol there; where that is none or not
/// Latin the first other that is, so that the keys work in every layout, as Qt's shortcuts do.
inline unsigned long symbolIn(const KeySymbols& symbols, std::size_t active) {
  // Latin letters and signs, and the keys that write nothing.
  const auto usual = [](unsigned long symbol) {
    return (symbol > 0 && symbol < 0x100) || (symbol >= 0xfe00 && symbol <= 0xffff);
  };
  if (active < symbols.size() && usual(symbols[active])) return symbols[active];
  for (const unsigned long symbol : symbols) {
    if (usual(symbol)) return symbol;
  }
  return 0;
}

}  // namespace pilothouse::gui
