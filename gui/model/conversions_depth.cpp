#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "doors/message_views.hpp"
#include "gui/model/conversions.hpp"

namespace pilothouse::gui {

namespace {

using Result = Converted<DepthPicture>;

// The rectified intrinsics when they are given, else the raw ones (as drivers without distortion
// fill them).
Intrinsics intrinsicsOf(const sensor_msgs::CameraInfo& info) {
  if (info.P[0] > 0.0) return {info.P[0], info.P[5], info.P[2], info.P[6]};
  return {info.K[0], info.K[4], info.K[2], info.K[5]};
}

// The pinhole that made an organised cloud, from the outermost points of its middle row; nothing
// where these are too near each other to tell.
std::optional<Intrinsics> intrinsicsOf(const CloudView& view) {
  const std::uint32_t row = view.height() / 2;
  std::optional<std::uint32_t> first, last;
  for (std::uint32_t column = 0; column < view.width(); ++column) {
    const Eigen::Vector3f p = view.point(row, column);
    if (!p.allFinite() || !(p.z() > 0.0F)) continue;
    if (!first) first = column;
    last = column;
  }
  if (!first || *last - *first < view.width() / 4) return std::nullopt;
  const auto slope = [&](std::uint32_t column) {
    const Eigen::Vector3d p = view.point(row, column).cast<double>();
    return p.x() / p.z();
  };
  const double focal = (*last - *first) / (slope(*last) - slope(*first));
  if (!std::isfinite(focal) || !(focal > 0.0)) return std::nullopt;
  return Intrinsics{focal, focal, *first - focal * slope(*first), view.height() * 0.5};
}

}  // namespace

Result DepthConverter::fromImage(const sensor_msgs::Image& image,
                                 const sensor_msgs::CameraInfo* info) {
  // Distances along the axis need no intrinsics; any sound ones open the view without them.
  const Intrinsics plain{1.0, 1.0, image.width * 0.5, image.height * 0.5};
  const DepthBytes bytes{image.width,
                         image.height,
                         image.step,
                         image.encoding,
                         image.is_bigendian != 0,
                         image.data.data(),
                         image.data.size(),
                         info ? info->width : image.width,
                         info ? info->height : image.height,
                         info ? intrinsicsOf(*info) : plain};
  const auto view = DepthView::open(bytes);
  if (!view) return Result::refused(view.reason());
  auto picture = std::make_shared<DepthPicture>();
  const std::uint32_t width = view->width();
  const std::uint32_t height = view->height();
  picture->metres.resize(std::size_t{width} * height);
  for (std::uint32_t row = 0; row < height; ++row) {
    float* out = picture->metres.data() + std::size_t{row} * width;
    for (std::uint32_t column = 0; column < width; ++column)
      out[column] = view->metres(row, column);
  }
  picture->frame = image.header.frame_id;
  if (info) picture->intrinsics = view->intrinsics();
  paint(*picture, static_cast<int>(width), static_cast<int>(height));
  return Result::of(std::move(picture));
}

Result DepthConverter::fromCloud(const sensor_msgs::PointCloud2& cloud) {
  const auto view = openView(cloud);
  if (!view) return Result::refused(view.reason());
  if (view->height() < 2) {
    return Result::refused("cloud of height " + std::to_string(view->height()) +
                           ": an organised one is needed for a picture");
  }
  auto picture = std::make_shared<DepthPicture>();
  const std::uint32_t width = view->width();
  picture->metres.resize(view->points());
  for (std::uint32_t row = 0; row < view->height(); ++row) {
    float* out = picture->metres.data() + std::size_t{row} * width;
    for (std::uint32_t column = 0; column < width; ++column) {
      const float z = view->point(row, column).z();
      out[column] = std::isfinite(z) && z > 0.0F ? z : 0.0F;
    }
  }
  picture->frame = cloud.header.frame_id;
  picture->intrinsics = intrinsicsOf(*view);
  paint(*picture, static_cast<int>(width), static_cast<int>(view->height()));
  return Result::of(std::move(picture));
}

void DepthConverter::paint(DepthPicture& picture, int width, int height) {
  picture.span = chooser_.update(picture.metres);
  picture.image = QImage(width, height, QImage::Format_RGB32);
  const float* metres = picture.metres.data();
  for (int row = 0; row < height; ++row) {
    auto* line = reinterpret_cast<QRgb*>(picture.image.scanLine(row));
    for (int column = 0; column < width; ++column)
      line[column] = ramp_.colour(*metres++, picture.span);
  }
}

}  // namespace pilothouse::gui
