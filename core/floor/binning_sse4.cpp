#include "core/floor/binning_kernel.hpp"

#ifdef __SSE4_1__  // set for this file alone where the processor is of this family

#include <smmintrin.h>

#include "core/floor/binning_lanes.hpp"

namespace pilothouse {
namespace {

/// Four points at a time. See binning_avx2.cpp for the reasons behind each step.
struct Sse4 {
  using Float = __m128;
  using Int = __m128i;
  static constexpr std::size_t kWidth = 4;

  static PILOTHOUSE_INLINE Float all(float value) { return _mm_set1_ps(value); }
  static PILOTHOUSE_INLINE Float load(const float* from) { return _mm_loadu_ps(from); }
  static PILOTHOUSE_INLINE Float both(Float a, Float b) { return _mm_and_ps(a, b); }
  static PILOTHOUSE_INLINE Float below(Float a, Float b) { return _mm_cmplt_ps(a, b); }
  static PILOTHOUSE_INLINE Float notAbove(Float a, Float b) { return _mm_cmple_ps(a, b); }
  static PILOTHOUSE_INLINE Float isPositive(Float a) { return _mm_cmplt_ps(_mm_setzero_ps(), a); }
  static PILOTHOUSE_INLINE bool noneTrue(Float mask) { return _mm_movemask_ps(mask) == 0; }
  static PILOTHOUSE_INLINE Float greater(Float a, Float b) { return _mm_max_ps(a, b); }
  static PILOTHOUSE_INLINE Int cut(Float a) { return _mm_cvttps_epi32(a); }
  static PILOTHOUSE_INLINE Int masked(Int a, Float mask) {
    return _mm_and_si128(a, _mm_castps_si128(mask));
  }

  template <std::size_t kStride>
  static PILOTHOUSE_INLINE void loadPoints(const std::uint8_t* p, std::size_t stride, Float& x,
                                           Float& y, Float& z) {
    if constexpr (kStride != 0) stride = kStride;
    const Float a = load(reinterpret_cast<const float*>(p));
    const Float b = load(reinterpret_cast<const float*>(p + stride));
    const Float c = load(reinterpret_cast<const float*>(p + 2 * stride));
    const Float d = load(reinterpret_cast<const float*>(p + 3 * stride));
    const Float xy_ab = _mm_unpacklo_ps(a, b), xy_cd = _mm_unpacklo_ps(c, d);
    x = _mm_movelh_ps(xy_ab, xy_cd);
    y = _mm_movehl_ps(xy_cd, xy_ab);
    z = _mm_movelh_ps(_mm_unpackhi_ps(a, b), _mm_unpackhi_ps(c, d));
  }

  static PILOTHOUSE_INLINE Float loadDepth(const std::uint8_t* p, std::uint16_t) {
    return _mm_cvtepi32_ps(
        _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))));
  }
  static PILOTHOUSE_INLINE Float loadDepth(const std::uint8_t* p, float) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(p));
  }

  static PILOTHOUSE_INLINE Int all32(std::uint32_t value) {
    return _mm_set1_epi32(static_cast<std::int32_t>(value));
  }
  static PILOTHOUSE_INLINE Int either(Int a, Int b) { return _mm_or_si128(a, b); }
  /// Each 32-bit lane gets these two 16-bit halves.
  static PILOTHOUSE_INLINE Int pairs(std::int32_t low, std::int32_t high) {
    return _mm_set1_epi32(low | high << 16);
  }
  static PILOTHOUSE_INLINE Int upperHalves(Int low, Int high) {
    return _mm_blend_epi16(_mm_srli_epi32(low, 16), high, 0xAA);
  }
  static PILOTHOUSE_INLINE Int lesser16(Int a, Int b) { return _mm_min_epu16(a, b); }
  static PILOTHOUSE_INLINE Int sumOfProducts16(Int a, Int b) { return _mm_madd_epi16(a, b); }

  template <class T>
  static PILOTHOUSE_INLINE void store(T* to, Int a) {
    _mm_store_si128(reinterpret_cast<__m128i*>(to), a);
  }
  /// Sums of one point each: first of the even lanes, then of the odd ones, because products of
  /// 32-bit numbers take every second lane. The lower half is q * q, the upper half `upper`.
  static PILOTHOUSE_INLINE void storePacked(std::uint64_t* to, Int q, Int upper) {
    const Int odd = _mm_shuffle_epi32(q, _MM_SHUFFLE(3, 3, 1, 1));
    const Int upper_even = _mm_shuffle_epi32(upper, _MM_SHUFFLE(2, 2, 0, 0));
    store(to, _mm_blend_epi16(_mm_mul_epu32(q, q), upper_even, 0xCC));
    store(to + kWidth / 2, _mm_blend_epi16(_mm_mul_epu32(odd, odd), upper, 0xCC));
  }
};

}  // namespace

const VectorKernel* sse4BinningKernel() {
  static constexpr VectorKernel kKernel = {addCloudLanes<Sse4>, addDepthLanes<Sse4>};
  return &kKernel;
}

}  // namespace pilothouse

#else

namespace pilothouse {
const VectorKernel* sse4BinningKernel() {
  return nullptr;
}
}  // namespace pilothouse

#endif
