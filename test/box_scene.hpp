#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Geometry>
#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <limits>

namespace pilothouse {

/// A box on an endless floor before a camera 0.65 m up that looks 26 degrees down, rendered without
/// noise: what the floor nodelets must see is known exactly.
struct BoxScene {
  static constexpr std::uint32_t kWidth = 320, kHeight = 240;
  static constexpr double kFocal = 262.5, kCx = 159.5, kCy = 119.5;
  Eigen::Vector3d low{1.2, -0.2, 0.0}, high{1.5, 0.2, 0.18};  ///< of the box, base frame [m]
  std::string frame = "camera_depth_optical_frame";

  static Eigen::Isometry3d T_base_optical() {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translate(Eigen::Vector3d(0.0, 0.0, 0.65));
    T.rotate(Eigen::AngleAxisd(26.0 * 3.14159265358979323846 / 180.0, Eigen::Vector3d::UnitY()));
    Eigen::Matrix3d optical;
    optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    T.rotate(Eigen::Quaterniond(optical));
    return T;
  }

  /// Depth of the pixel [m]; infinite towards the sky.
  double depthAt(std::uint32_t row, std::uint32_t col) const {
    const Eigen::Isometry3d T = T_base_optical();
    const Eigen::Vector3d from = T.translation();
    const Eigen::Vector3d way =
        T.linear() * Eigen::Vector3d((col - kCx) / kFocal, (row - kCy) / kFocal, 1.0);
    double depth = std::numeric_limits<double>::infinity();
    if (way.z() < 0.0) depth = -from.z() / way.z();
    double in = 0.0, out = depth;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low[axis] - from[axis]) / way[axis];
      const double b = (high[axis] - from[axis]) / way[axis];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return in <= out ? in : depth;
  }

  std_msgs::Header header(double stamp) const {
    std_msgs::Header header;
    header.stamp = ros::Time(stamp);
    header.frame_id = frame;
    return header;
  }

  sensor_msgs::Image::Ptr image(double stamp) const {
    auto image = boost::make_shared<sensor_msgs::Image>();
    image->header = header(stamp);
    image->width = kWidth;
    image->height = kHeight;
    image->step = kWidth * 2;
    image->encoding = "16UC1";
    image->data.resize(std::size_t{image->step} * kHeight);
    for (std::uint32_t row = 0; row < kHeight; ++row) {
      for (std::uint32_t col = 0; col < kWidth; ++col) {
        const double depth = depthAt(row, col);
        const auto millimetres = static_cast<std::uint16_t>(depth < 10.0 ? depth * 1e3 + 0.5 : 0.0);
        std::memcpy(&image->data[std::size_t{row} * image->step + col * 2], &millimetres, 2);
      }
    }
    return image;
  }

  sensor_msgs::CameraInfo::Ptr info(double stamp) const {
    auto info = boost::make_shared<sensor_msgs::CameraInfo>();
    info->header = header(stamp);
    info->width = kWidth;
    info->height = kHeight;
    info->K = {kFocal, 0, kCx, 0, kFocal, kCy, 0, 0, 1};
    info->P = {kFocal, 0, kCx, 0, 0, kFocal, kCy, 0, 0, 0, 1, 0};
    return info;
  }

  sensor_msgs::PointCloud2::Ptr cloud(double stamp) const {
    auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
    cloud->header = header(stamp);
    cloud->width = kWidth;
    cloud->height = kHeight;
    cloud->point_step = 16;
    cloud->row_step = kWidth * cloud->point_step;
    cloud->fields.resize(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
      cloud->fields[i].name = std::string(1, "xyz"[i]);
      cloud->fields[i].offset = 4 * i;
      cloud->fields[i].datatype = sensor_msgs::PointField::FLOAT32;
      cloud->fields[i].count = 1;
    }
    cloud->data.resize(std::size_t{cloud->row_step} * kHeight);
    for (std::uint32_t row = 0; row < kHeight; ++row) {
      for (std::uint32_t col = 0; col < kWidth; ++col) {
        const double depth = depthAt(row, col);
        const Eigen::Vector3f point(static_cast<float>((col - kCx) / kFocal * depth),
                                    static_cast<float>((row - kCy) / kFocal * depth),
                                    static_cast<float>(depth));
        std::memcpy(&cloud->data[std::size_t{row} * cloud->row_step + col * 16], point.data(), 12);
      }
    }
    return cloud;
  }
};

}  // namespace pilothouse
