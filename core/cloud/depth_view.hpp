#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// Pinhole intrinsics of a rectified image, in pixels.
struct Intrinsics {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
};

/// The parts of a depth Image and its CameraInfo as received (untrusted). Borrows all it points to.
struct DepthBytes {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t step;  ///< bytes a row
  std::string_view encoding;
  bool is_bigendian;
  const std::uint8_t* data;
  std::size_t size;          ///< bytes at data
  std::uint32_t info_width;  ///< CameraInfo; must agree with the image
  std::uint32_t info_height;
  Intrinsics intrinsics;  ///< CameraInfo P (rectified) or K
};

/// Largest image that is read: 8192 pixels a side, 2^24 pixels.
struct DepthBounds {
  std::uint32_t max_side = 8192;
  std::size_t max_pixels = std::size_t{1} << 24;
};

enum class DepthEncoding { kMillimetres16, kMetres32 };

/// Checked, non-owning view over a depth image: 16UC1 in millimetres (0: no measurement) or 32FC1
/// in metres (NaN, infinite or not positive: no measurement). Depth is along the optical axis.
/// mono16, which some drivers send, is read as 16UC1.
class DepthView {
 public:
  /// Refuses, with the reason, whatever cannot be read safely. Looks at sizes before any byte.
  /// Refused besides: an image without pixels, big endian, a step that splits a pixel, a CameraInfo
  /// of another size, focal lengths outside 1 to 100000 pixels (0: the camera is not calibrated).
  static Checked<DepthView> open(const DepthBytes& bytes, const DepthBounds& bounds = {});

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t step() const { return step_; }
  DepthEncoding encoding() const { return encoding_; }
  const Intrinsics& intrinsics() const { return intrinsics_; }
  /// Bytes of a row: width() pixels are readable. Their alignment is that of the data received:
  /// copy, do not cast. @param row below height().
  const std::uint8_t* row(std::uint32_t row) const { return data_ + std::size_t{row} * step_; }
  /// Depth in metres at (row, col); 0 where there is no measurement.
  float metres(std::uint32_t row_index, std::uint32_t col) const;

 private:
  const std::uint8_t* data_ = nullptr;
  std::uint32_t width_ = 0, height_ = 0, step_ = 0;
  DepthEncoding encoding_ = DepthEncoding::kMillimetres16;
  Intrinsics intrinsics_;
};

}  // namespace pilothouse
