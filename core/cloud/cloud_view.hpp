#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// One entry of a PointCloud2's field list, as received (untrusted).
struct CloudField {
  std::string_view name;
  std::uint32_t offset;   ///< bytes from the start of a point
  std::uint8_t datatype;  ///< of the message PointField; 7 is float32
  std::uint32_t count;
};

/// The parts of a PointCloud2 as received (untrusted). Borrows everything it points to.
struct CloudBytes {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t point_step;  ///< bytes
  std::uint32_t row_step;    ///< bytes
  bool is_bigendian;
  const CloudField* fields;
  std::size_t field_count;
  const std::uint8_t* data;
  std::size_t size;  ///< bytes at data
};

/// Largest cloud that is read: 2^22 points, 2^28 bytes, 64 fields.
struct CloudBounds {
  std::size_t max_points = std::size_t{1} << 22;
  std::size_t max_bytes = std::size_t{1} << 28;
  std::size_t max_fields = 64;
};

/// Checked, non-owning view of x y z (float32, little endian, metres, sensor frame) over the bytes
/// of a PointCloud2 at any offsets, point step and row step; organised or not. NaN or infinite
/// coordinates mean "no measurement". Valid as long as the bytes are.
class CloudView {
 public:
  /// Refuses, with the reason, whatever cannot be read safely. Looks at sizes before any byte.
  /// Accepted: x y z once each, float32, count 1 (or 0, which many publishers leave), inside the
  /// point and apart from one another; any further fields; a row_step with padding, also missing
  /// after the last row; more data than needed. A cloud without points (width or height 0) says
  /// "nothing measured" and opens as a view of 0 x 0, its fields checked all the same.
  /// Refused: big endian.
  static Checked<CloudView> open(const CloudBytes& bytes, const CloudBounds& bounds = {});

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::size_t points() const { return std::size_t{width_} * height_; }
  std::uint32_t pointStep() const { return point_step_; }
  std::uint32_t rowStep() const { return row_step_; }
  std::uint32_t xOffset() const { return x_offset_; }
  std::uint32_t yOffset() const { return y_offset_; }
  std::uint32_t zOffset() const { return z_offset_; }
  /// width * pointStep readable bytes of the row, of any alignment. @param row below height().
  const std::uint8_t* row(std::uint32_t row) const { return data_ + std::size_t{row} * row_step_; }
  /// Point in column `col` of row `row`, [m].
  Eigen::Vector3f point(std::uint32_t row_index, std::uint32_t col) const {
    const std::uint8_t* p = row(row_index) + std::size_t{col} * point_step_;
    Eigen::Vector3f v;
    std::memcpy(&v.x(), p + x_offset_, sizeof(float));
    std::memcpy(&v.y(), p + y_offset_, sizeof(float));
    std::memcpy(&v.z(), p + z_offset_, sizeof(float));
    return v;
  }

 private:
  const std::uint8_t* data_ = nullptr;
  std::uint32_t width_ = 0, height_ = 0, point_step_ = 0, row_step_ = 0;
  std::uint32_t x_offset_ = 0, y_offset_ = 0, z_offset_ = 0;
};

}  // namespace pilothouse
