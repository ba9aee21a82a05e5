#include "core/cloud/cloud_view.hpp"

namespace pilothouse {

Checked<CloudView> CloudView::open(const CloudBytes& bytes, const CloudBounds&) {
  CloudView view;
  view.data_ = bytes.data;
  view.width_ = bytes.width;
  view.height_ = bytes.height;
  view.point_step_ = bytes.point_step;
  view.row_step_ = bytes.row_step;
  for (std::size_t i = 0; i < bytes.field_count; ++i) {
    if (bytes.fields[i].name == "x") view.x_offset_ = bytes.fields[i].offset;
    if (bytes.fields[i].name == "y") view.y_offset_ = bytes.fields[i].offset;
    if (bytes.fields[i].name == "z") view.z_offset_ = bytes.fields[i].offset;
  }
  return Checked<CloudView>::of(view);
}

}  // namespace pilothouse
