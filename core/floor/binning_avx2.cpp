#include "core/floor/binning_kernel.hpp"

#ifdef __AVX2__  // set for this file alone where the processor is of this family

#include <immintrin.h>

#include "core/floor/binning_lanes.hpp"

namespace pilothouse {
namespace {

/// Eight points at a time.
struct Avx2 {
  using Float = __m256;
  using Int = __m256i;
  static constexpr std::size_t kWidth = 8;

  static PILOTHOUSE_INLINE Float all(float value) { return _mm256_set1_ps(value); }
  static PILOTHOUSE_INLINE Float load(const float* from) { return _mm256_loadu_ps(from); }
  static PILOTHOUSE_INLINE Float allTrue() { return _mm256_castsi256_ps(_mm256_set1_epi32(-1)); }
  static PILOTHOUSE_INLINE Float both(Float a, Float b) { return _mm256_and_ps(a, b); }
  static PILOTHOUSE_INLINE Float below(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static PILOTHOUSE_INLINE Float notAbove(Float a, Float b) {
    return _mm256_cmp_ps(a, b, _CMP_LE_OQ);
  }
  static PILOTHOUSE_INLINE Float isPositive(Float a) {
    return _mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_GT_OQ);
  }
  static PILOTHOUSE_INLINE bool noneTrue(Float mask) { return _mm256_movemask_ps(mask) == 0; }
  static PILOTHOUSE_INLINE Float greater(Float a, Float b) { return _mm256_max_ps(a, b); }
  static PILOTHOUSE_INLINE Float lesser(Float a, Float b) { return _mm256_min_ps(a, b); }
  static PILOTHOUSE_INLINE Int cut(Float a) { return _mm256_cvttps_epi32(a); }
  static PILOTHOUSE_INLINE Int masked(Int a, Float mask) {
    return _mm256_and_si256(a, _mm256_castps_si256(mask));
  }

  /// Loads of 16 bytes a point and a transpose: cheaper than a gather. The points come in a mixed
  /// order, which the sums do not notice.
  template <std::size_t kStride>
  static PILOTHOUSE_INLINE void loadPoints(const std::uint8_t* p, std::size_t stride, Float& x,
                                           Float& y, Float& z) {
    const Float a = loadTwo<kStride>(p, stride);
    const Float b = loadTwo<kStride>(p + 2 * stride, stride);
    const Float c = loadTwo<kStride>(p + 4 * stride, stride);
    const Float d = loadTwo<kStride>(p + 6 * stride, stride);
    const Float xy_ab = _mm256_unpacklo_ps(a, b), xy_cd = _mm256_unpacklo_ps(c, d);
    x = _mm256_shuffle_ps(xy_ab, xy_cd, _MM_SHUFFLE(1, 0, 1, 0));
    y = _mm256_shuffle_ps(xy_ab, xy_cd, _MM_SHUFFLE(3, 2, 3, 2));
    z = _mm256_shuffle_ps(_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d),
                          _MM_SHUFFLE(1, 0, 1, 0));
  }
  template <std::size_t kStride>
  static PILOTHOUSE_INLINE Float loadTwo(const std::uint8_t* p, std::size_t stride) {
    if constexpr (kStride == 16) return _mm256_loadu_ps(reinterpret_cast<const float*>(p));
    return _mm256_insertf128_ps(
        _mm256_castps128_ps256(_mm_loadu_ps(reinterpret_cast<const float*>(p))),
        _mm_loadu_ps(reinterpret_cast<const float*>(p + stride)), 1);
  }

  static PILOTHOUSE_INLINE Float loadDepth(const std::uint8_t* p, std::uint16_t) {
    return _mm256_cvtepi32_ps(
        _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))));
  }
  static PILOTHOUSE_INLINE Float loadDepth(const std::uint8_t* p, float) {
    return _mm256_loadu_ps(reinterpret_cast<const float*>(p));
  }

  /// Byte offset of the slot: (iy * columns + ix) * 64.
  static PILOTHOUSE_INLINE Int slotOffset(Int ix, Int iy, std::int32_t columns) {
    return _mm256_slli_epi32(
        _mm256_add_epi32(_mm256_mullo_epi32(iy, _mm256_set1_epi32(columns)), ix), 6);
  }

  static PILOTHOUSE_INLINE void addToSlots(Int offsets, Int q, std::uint8_t* slots) {
    // Offsets go through memory: eight scalar loads are cheaper than eight extractions.
    alignas(32) std::uint32_t at[kWidth];
    _mm256_store_si256(reinterpret_cast<__m256i*>(at), offsets);
    asm("" : "+m"(at));  // keeps the compiler from extracting after all
    // vpmuludq squares the even lanes into 64 bits each, so that { q, 1, q * q } of four points
    // need only a blend and an interleave.
    const Int one = _mm256_set1_epi32(1);
    const Int odd = _mm256_srli_epi64(q, 32);
    const Int even_low = _mm256_blend_epi32(q, one, 0xAA);
    const Int odd_low = _mm256_blend_epi32(odd, one, 0xAA);
    const Int even_square = _mm256_mul_epu32(q, q);
    const Int odd_square = _mm256_mul_epu32(odd, odd);
    const Int p04 = _mm256_unpacklo_epi64(even_low, even_square);
    const Int p26 = _mm256_unpackhi_epi64(even_low, even_square);
    const Int p15 = _mm256_unpacklo_epi64(odd_low, odd_square);
    const Int p37 = _mm256_unpackhi_epi64(odd_low, odd_square);
    addToCopy<0>(slots + at[0], _mm256_castsi256_si128(p04));
    addToCopy<1>(slots + at[1], _mm256_castsi256_si128(p15));
    addToCopy<2>(slots + at[2], _mm256_castsi256_si128(p26));
    addToCopy<3>(slots + at[3], _mm256_castsi256_si128(p37));
    addToCopy<0>(slots + at[4], _mm256_extracti128_si256(p04, 1));
    addToCopy<1>(slots + at[5], _mm256_extracti128_si256(p15, 1));
    addToCopy<2>(slots + at[6], _mm256_extracti128_si256(p26, 1));
    addToCopy<3>(slots + at[7], _mm256_extracti128_si256(p37, 1));
  }
  template <int kCopy>
  static PILOTHOUSE_INLINE void addToCopy(std::uint8_t* slot, __m128i value) {
    auto* copy = reinterpret_cast<__m128i*>(slot) + kCopy;
    _mm_store_si128(copy, _mm_add_epi64(_mm_load_si128(copy), value));
  }
};

}  // namespace

const VectorKernel* avx2BinningKernel() {
  static constexpr VectorKernel kKernel = {addCloudLanes<Avx2>, addDepthLanes<Avx2>};
  return &kKernel;
}

}  // namespace pilothouse

#else

namespace pilothouse {
const VectorKernel* avx2BinningKernel() {
  return nullptr;
}
}  // namespace pilothouse

#endif
