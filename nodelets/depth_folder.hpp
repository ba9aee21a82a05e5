#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <string>
#include <vector>

#include "core/replay/frame_pairs.hpp"

namespace pilothouse {

/// Reads an intrinsics file as Open3D writes it: width, height, and intrinsic_matrix as nine
/// numbers, column by column. @throws std::runtime_error naming the key, value and what was
/// expected.
sensor_msgs::CameraInfo readIntrinsics(const std::string& path);

/// A picture of a depth camera without stamps and frames; colour is empty where there is none.
struct DepthFrame {
  sensor_msgs::Image depth;   ///< 16UC1, mm
  sensor_msgs::Image colour;  ///< bgr8
};

/// A folder of *_depth.png (16 bits, mm), *_color.png of the same pixels, and one *.json with
/// their common intrinsics.
class DepthFolder {
 public:
  /// @throws std::runtime_error with the reason why the folder cannot be played.
  explicit DepthFolder(const std::string& folder);

  const std::vector<FramePair>& frames() const { return frames_; }
  const sensor_msgs::CameraInfo& info() const { return info_; }
  /// @throws std::runtime_error with the reason why the depth picture is refused, or naming the
  ///   colour picture and why that is.
  DepthFrame read(std::size_t frame) const;

 private:
  std::string folder_;
  std::vector<FramePair> frames_;
  sensor_msgs::CameraInfo info_;
};

}  // namespace pilothouse
