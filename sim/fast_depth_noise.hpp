#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/depth_noise.hpp"

namespace pilothouse::sim {

/// DepthNoise for a picture at a time. Its random numbers are counted, not drawn one after the
/// other: a pixel's depends on seed, frame and pixel alone, so that neither order nor processor
/// matters. DepthNoise::measure is the reference that the test compares it with.
class FastDepthNoise {
 public:
  /// @throws std::invalid_argument where a measurement would not fit the picture: farthest must be
  /// below 65.5 m, nearest above 0.
  explicit FastDepthNoise(const DepthNoise& noise);

  /// @param depths perfect ones [m], 0: none. @param millimetres as many, 0: not measured.
  void measure(const float* depths, std::size_t count, std::uint64_t seed, std::uint64_t frame,
               std::uint16_t* millimetres) const;
  /// The same without vector instructions, for the test that both give the same bytes.
  void measurePlain(const float* depths, std::size_t count, std::uint64_t seed, std::uint64_t frame,
                    std::uint16_t* millimetres) const;

 private:
  DepthNoise noise_;
};

}  // namespace pilothouse::sim
