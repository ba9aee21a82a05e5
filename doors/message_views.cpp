#include "doors/message_views.hpp"

#include <algorithm>
#include <array>

namespace pilothouse {

Checked<CloudView> openView(const sensor_msgs::PointCloud2& cloud) {
  // The view refuses more fields than these without looking at them.
  std::array<CloudField, CloudBounds{}.max_fields> fields;
  const std::size_t described = std::min(cloud.fields.size(), fields.size());
  for (std::size_t i = 0; i < described; ++i) {
    const auto& field = cloud.fields[i];
    fields[i] = {field.name, field.offset, field.datatype, field.count};
  }
  CloudBytes bytes{};
  bytes.width = cloud.width;
  bytes.height = cloud.height;
  bytes.point_step = cloud.point_step;
  bytes.row_step = cloud.row_step;
  bytes.is_bigendian = cloud.is_bigendian != 0;
  bytes.fields = fields.data();
  bytes.field_count = cloud.fields.size();
  bytes.data = cloud.data.data();
  bytes.size = cloud.data.size();
  return CloudView::open(bytes);
}

Checked<DepthView> openView(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info) {
  DepthBytes bytes{};
  bytes.width = image.width;
  bytes.height = image.height;
  bytes.step = image.step;
  bytes.encoding = image.encoding;
  bytes.is_bigendian = image.is_bigendian != 0;
  bytes.data = image.data.data();
  bytes.size = image.data.size();
  bytes.info_width = info.width;
  bytes.info_height = info.height;
  const bool rectified = info.P[0] != 0.0;
  bytes.intrinsics = rectified ? Intrinsics{info.P[0], info.P[5], info.P[2], info.P[6]}
                               : Intrinsics{info.K[0], info.K[4], info.K[2], info.K[5]};
  return DepthView::open(bytes);
}

}  // namespace pilothouse
