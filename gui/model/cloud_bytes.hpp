#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <vector>

#include "core/cloud/cloud_view.hpp"

namespace pilothouse::gui {

/// The message as the checked door takes it. @param fields holds what the result borrows; at most
/// one more field than the door accepts is copied.
inline CloudBytes cloudBytes(const sensor_msgs::PointCloud2& cloud,
                             std::vector<CloudField>& fields) {
  fields.clear();
  for (const auto& field : cloud.fields) {
    if (fields.size() > CloudBounds{}.max_fields) break;
    fields.push_back({field.name, field.offset, field.datatype, field.count});
  }
  return {
      cloud.width,   cloud.height,  cloud.point_step,  cloud.row_step,   cloud.is_bigendian != 0,
      fields.data(), fields.size(), cloud.data.data(), cloud.data.size()};
}

}  // namespace pilothouse::gui
