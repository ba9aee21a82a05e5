#include "bench/stream_read.hpp"

#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace pilothouse::bench {
namespace {

std::uint64_t plainRead(const std::uint8_t* p, std::size_t size) {
  std::uint64_t all = 0;
  for (; size >= 8; p += 8, size -= 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, p, sizeof word);
    all |= word;
  }
  for (; size > 0; ++p, --size) all |= *p;
  return all;
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) std::uint64_t wideRead(const std::uint8_t* p, std::size_t size) {
  // Four accumulators, so that no load waits for an OR.
  __m256i all[4] = {};
  for (; size >= 128; p += 128, size -= 128) {
    for (int i = 0; i < 4; ++i) {
      const auto* from = reinterpret_cast<const __m256i*>(p) + i;
      all[i] = _mm256_or_si256(all[i], _mm256_loadu_si256(from));
    }
  }
  alignas(32) std::uint64_t words[4];
  _mm256_store_si256(
      reinterpret_cast<__m256i*>(words),
      _mm256_or_si256(_mm256_or_si256(all[0], all[1]), _mm256_or_si256(all[2], all[3])));
  return words[0] | words[1] | words[2] | words[3] | plainRead(p, size);
}
#endif

}  // namespace

unsigned long long streamRead(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return wideRead(bytes, size);
#endif
  return plainRead(bytes, size);
}

bool evict(const void* data, std::size_t size) {
#if defined(__x86_64__)
  const auto* bytes = static_cast<const char*>(data);
  for (std::size_t i = 0; i < size; i += 64) _mm_clflush(bytes + i);
  if (size > 0) _mm_clflush(bytes + size - 1);
  _mm_mfence();
  return true;
#else
  static_cast<void>(data);
  static_cast<void>(size);
  return false;
#endif
}

}  // namespace pilothouse::bench
