#include "core/cloud/cloud_view.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace pilothouse {
namespace {

constexpr std::uint8_t kFloat32 = 7;  // PointField::FLOAT32
constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
using Reason = std::optional<std::string>;

std::string found(const std::string& thing, std::uint64_t value, const std::string& expected) {
  return "cloud " + thing + " is " + std::to_string(value) + ", expected " + expected;
}

/// Sizes of width, height and bytes. In 64 bits nothing here overflows: the points are bounded
/// before anything is multiplied by them.
Reason sizeFault(const CloudBytes& bytes, const CloudBounds& bounds) {
  const std::uint64_t points = std::uint64_t{bytes.width} * bytes.height;
  if (points > bounds.max_points)
    return "cloud size is " + std::to_string(bytes.width) + " x " + std::to_string(bytes.height) +
           ", expected at most " + std::to_string(bounds.max_points) + " points";
  if (bytes.size > bounds.max_bytes)
    return found("data", bytes.size, "at most " + std::to_string(bounds.max_bytes) + " bytes");
  if (bytes.data == nullptr && bytes.size > 0) return "cloud data is null, expected bytes";
  if (points == 0) return {};
  const std::uint64_t row = std::uint64_t{bytes.width} * bytes.point_step;
  if (bytes.row_step < row)
    return found("row_step", bytes.row_step,
                 "at least width * point_step = " + std::to_string(row) + " bytes");
  const std::uint64_t needed = (std::uint64_t{bytes.height} - 1) * bytes.row_step + row;
  if (bytes.size < needed)
    return found("data", bytes.size, "at least " + std::to_string(needed) + " bytes");
  return {};
}

/// The one field called `name`, or why there is none that can be read.
Checked<std::uint32_t> offsetOf(std::string_view name, const CloudBytes& bytes) {
  using Result = Checked<std::uint32_t>;
  const std::string thing = "field " + std::string(name);
  const CloudField* field = nullptr;
  for (std::size_t i = 0; i < bytes.field_count; ++i) {
    if (bytes.fields[i].name != name) continue;
    if (field != nullptr)
      return Result::refused("cloud " + thing + " is there twice, expected once");
    field = &bytes.fields[i];
  }
  if (field == nullptr) return Result::refused("cloud " + thing + " is missing, expected float32");
  if (field->datatype != kFloat32)
    return Result::refused(found(thing + " datatype", field->datatype, "7 (float32)"));
  if (field->count > 1) return Result::refused(found(thing + " count", field->count, "1"));
  if (std::uint64_t{field->offset} + sizeof(float) > bytes.point_step)
    return Result::refused(
        found(thing + " offset", field->offset,
              "4 bytes inside the point_step of " + std::to_string(bytes.point_step)));
  return Result::of(field->offset);
}

Reason overlap(const std::array<std::uint32_t, 3>& offsets) {
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a + 1; b < 3; ++b) {
      const std::uint32_t low = std::min(offsets[a], offsets[b]);
      const std::uint32_t high = std::max(offsets[a], offsets[b]);
      if (high - low < sizeof(float))
        return found(
            "field " + std::string(kAxes[b]) + " offset", offsets[b],
            "no overlap with field " + std::string(kAxes[a]) + " at " + std::to_string(offsets[a]));
    }
  return {};
}

}  // namespace

Checked<CloudView> CloudView::open(const CloudBytes& bytes, const CloudBounds& bounds) {
  using Result = Checked<CloudView>;
  if (bytes.is_bigendian) return Result::refused("cloud is_bigendian is true, expected false");
  if (bytes.point_step == 0) return Result::refused("cloud point_step is 0, expected 12 or more");
  if (bytes.field_count > bounds.max_fields)
    return Result::refused(
        found("fields", bytes.field_count, "at most " + std::to_string(bounds.max_fields)));
  if (bytes.fields == nullptr && bytes.field_count > 0)
    return Result::refused("cloud fields is null, expected x y z");
  if (const Reason fault = sizeFault(bytes, bounds)) return Result::refused(*fault);

  std::array<std::uint32_t, 3> offsets{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto offset = offsetOf(kAxes[axis], bytes);
    if (!offset) return Result::refused(offset.reason());
    offsets[axis] = *offset;
  }
  if (const Reason fault = overlap(offsets)) return Result::refused(*fault);

  const bool empty = bytes.width == 0 || bytes.height == 0;
  CloudView view;
  view.data_ = bytes.data;
  view.width_ = empty ? 0 : bytes.width;
  view.height_ = empty ? 0 : bytes.height;
  view.point_step_ = bytes.point_step;
  view.row_step_ = bytes.row_step;
  view.x_offset_ = offsets[0];
  view.y_offset_ = offsets[1];
  view.z_offset_ = offsets[2];
  return Result::of(view);
}

}  // namespace pilothouse
