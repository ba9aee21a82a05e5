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

  static PILOTHOUSE_INLINE Int all32(std::uint32_t value) {
    return _mm256_set1_epi32(static_cast<std::int32_t>(value));
  }
  static PILOTHOUSE_INLINE Int either(Int a, Int b) { return _mm256_or_si256(a, b); }
  /// Each 32-bit lane gets these two 16-bit halves.
  static PILOTHOUSE_INLINE Int pairs(std::int32_t low, std::int32_t high) {
    return _mm256_set1_epi32(low | high << 16);
  }
  static PILOTHOUSE_INLINE Int upperHalves(Int low, Int high) {
    return _mm256_blend_epi16(_mm256_srli_epi32(low, 16), high, 0xAA);
  }
  static PILOTHOUSE_INLINE Int lesser16(Int a, Int b) { return _mm256_min_epu16(a, b); }
  static PILOTHOUSE_INLINE Int sumOfProducts16(Int a, Int b) { return _mm256_madd_epi16(a, b); }

  template <class T>
  static PILOTHOUSE_INLINE void store(T* to, Int a) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(to), a);
  }
  /// Sums of one point each: first of the even lanes, then of the odd ones, because products of
  /// 32-bit numbers take every second lane. The lower half is q * q, the upper half `upper`.
  static PILOTHOUSE_INLINE void storePacked(std::uint64_t* to, Int q, Int upper) {
    const Int odd = _mm256_shuffle_epi32(q, _MM_SHUFFLE(3, 3, 1, 1));
    const Int upper_even = _mm256_shuffle_epi32(upper, _MM_SHUFFLE(2, 2, 0, 0));
    store(to, _mm256_blend_epi32(_mm256_mul_epu32(q, q), upper_even, 0xAA));
    store(to + kWidth / 2, _mm256_blend_epi32(_mm256_mul_epu32(odd, odd), upper, 0xAA));
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
