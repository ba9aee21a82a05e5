#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "sim/floor_scene.hpp"

namespace pilothouse::bench {

/// The frame that every benchmark measures: a Kinect 0.65 m high, pitched down 26 degrees, before
/// boxes of 7 and 18 cm and a wall, 640x480, with the sensor's noise; about 304,000 valid points.
/// The same frame as 16-bit depth and as clouds of 16 (x y z rgb) and 32 (PCL's PointXYZRGB) bytes
/// a point, in the optical frame.
class StandardFrame {
 public:
  StandardFrame();

  DepthView depth() const;
  CloudView cloud16() const { return cloud(cloud16_, 16); }
  CloudView cloud32() const { return cloud(cloud32_, 32); }
  const std::vector<std::uint16_t>& depthPixels() const { return depth_; }
  const std::vector<float>& cloud16Words() const { return cloud16_; }
  const std::vector<float>& cloud32Words() const { return cloud32_; }
  const sim::CameraModel& camera() const { return camera_; }
  const Eigen::Isometry3f& T_base_optical() const { return T_base_optical_; }
  /// Points with a measurement, optical frame [m].
  const std::vector<Eigen::Vector3f>& validPoints() const { return valid_points_; }

 private:
  CloudView cloud(const std::vector<float>& words, std::uint32_t point_step) const;

  sim::CameraModel camera_;
  Eigen::Isometry3f T_base_optical_;
  std::vector<std::uint16_t> depth_;
  std::vector<float> cloud16_, cloud32_;
  std::vector<Eigen::Vector3f> valid_points_;
};

}  // namespace pilothouse::bench
