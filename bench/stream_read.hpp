#pragma once

#include <cstddef>

namespace pilothouse::bench {

/// Reads every byte at the full speed of the memory: the limit that any reader of a cloud meets.
/// 256-bit loads where the processor has them, folded by OR. Returns something that depends on
/// every byte.
unsigned long long streamRead(const void* data, std::size_t size);

/// Throws the bytes out of every cache. False where this kind of processor is not known.
bool evict(const void* data, std::size_t size);

}  // namespace pilothouse::bench
