#include "core/cloud/depth_view.hpp"

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "core/cloud/quoted.hpp"

namespace pilothouse {
namespace {

using Reason = std::optional<std::string>;

std::string found(const std::string& thing, std::uint64_t value, const std::string& expected) {
  return "depth image " + thing + " is " + std::to_string(value) + ", expected " + expected;
}

Reason sizeFault(const DepthBytes& bytes, const DepthBounds& bounds, std::uint32_t pixel) {
  const std::string side = "1 to " + std::to_string(bounds.max_side) + " pixels";
  if (bytes.width == 0 || bytes.width > bounds.max_side) return found("width", bytes.width, side);
  if (bytes.height == 0 || bytes.height > bounds.max_side)
    return found("height", bytes.height, side);
  const std::uint64_t pixels = std::uint64_t{bytes.width} * bytes.height;
  if (pixels > bounds.max_pixels)
    return found("size", pixels, "at most " + std::to_string(bounds.max_pixels) + " pixels");
  const std::uint64_t row = std::uint64_t{bytes.width} * pixel;
  if (bytes.step < row)
    return found(
        "step", bytes.step,
        "at least width * " + std::to_string(pixel) + " = " + std::to_string(row) + " bytes");
  if (bytes.step % pixel != 0)
    return found("step", bytes.step, "a multiple of " + std::to_string(pixel) + " bytes");
  if (bytes.data == nullptr) return "depth image data is null, expected bytes";
  const std::uint64_t needed = (std::uint64_t{bytes.height} - 1) * bytes.step + row;
  if (bytes.size < needed)
    return found("data", bytes.size, "at least " + std::to_string(needed) + " bytes");
  return {};
}

Reason outside(const char* thing, double value, double low, double high) {
  if (value >= low && value <= high) return {};  // false for NaN
  std::ostringstream text;
  text << "CameraInfo " << thing << " is " << value << ", expected " << low << " to " << high
       << " pixels";
  return text.str();
}

Reason cameraFault(const DepthBytes& bytes) {
  if (bytes.info_width != bytes.width || bytes.info_height != bytes.height)
    return "CameraInfo size is " + std::to_string(bytes.info_width) + " x " +
           std::to_string(bytes.info_height) + ", expected " + std::to_string(bytes.width) + " x " +
           std::to_string(bytes.height) + " as the depth image";
  const Intrinsics& k = bytes.intrinsics;
  if (k.fx == 0.0 && k.fy == 0.0) return "CameraInfo fx and fy are 0, expected a calibrated camera";
  // A focal length of a millionth pixel would turn depth into coordinates beyond any float.
  constexpr double kLeastFocal = 1.0;
  constexpr double kFar = 1e5;
  if (auto fault = outside("fx", k.fx, kLeastFocal, kFar)) return fault;
  if (auto fault = outside("fy", k.fy, kLeastFocal, kFar)) return fault;
  if (auto fault = outside("cx", k.cx, -kFar, kFar)) return fault;
  return outside("cy", k.cy, -kFar, kFar);
}

}  // namespace

Checked<DepthView> DepthView::open(const DepthBytes& bytes, const DepthBounds& bounds) {
  using Result = Checked<DepthView>;
  const bool metres = bytes.encoding == "32FC1";
  if (!metres && bytes.encoding != "16UC1" && bytes.encoding != "mono16")
    return Result::refused("depth image encoding is " + quoted(bytes.encoding) +
                           ", expected 16UC1, mono16 or 32FC1");
  if (bytes.is_bigendian)
    return Result::refused("depth image is_bigendian is true, expected false");
  if (const Reason fault = sizeFault(bytes, bounds, metres ? 4 : 2)) return Result::refused(*fault);
  if (const Reason fault = cameraFault(bytes)) return Result::refused(*fault);

  DepthView view;
  view.data_ = bytes.data;
  view.width_ = bytes.width;
  view.height_ = bytes.height;
  view.step_ = bytes.step;
  view.encoding_ = metres ? DepthEncoding::kMetres32 : DepthEncoding::kMillimetres16;
  view.intrinsics_ = bytes.intrinsics;
  return Result::of(view);
}

float DepthView::metres(std::uint32_t row_index, std::uint32_t col) const {
  if (encoding_ == DepthEncoding::kMillimetres16) {
    std::uint16_t millimetres = 0;
    std::memcpy(&millimetres, row(row_index) + std::size_t{col} * 2, 2);
    return static_cast<float>(millimetres) * 0.001F;
  }
  float metres = 0.0F;
  std::memcpy(&metres, row(row_index) + std::size_t{col} * 4, 4);
  return std::isfinite(metres) && metres > 0.0F ? metres : 0.0F;
}

}  // namespace pilothouse
