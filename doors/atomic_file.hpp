#pragma once

#include <string>
#include <string_view>

namespace pilothouse {

/// Writes a file so that at every moment, whatever ends this process or the machine, either what
/// was there before is there whole, or the new: a temporary file beside it, synchronised, renamed,
/// and its folder synchronised.
/// One writer a file at a time.
/// @throws std::runtime_error with the reason; then the old file is unharmed.
void writeAtomically(const std::string& path, std::string_view bytes);

}  // namespace pilothouse
