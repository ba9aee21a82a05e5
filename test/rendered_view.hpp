#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/cloud/depth_view.hpp"
#include "sim/depth_noise.hpp"
#include "sim/floor_scene.hpp"
#include "sim/random.hpp"

namespace pilothouse {

/// A rendered 16UC1 picture of a scene, with the noise of a Kinect.
class RenderedView {
 public:
  RenderedView(const sim::FloorScene& scene, const sim::Mounting& mounting, std::uint64_t seed = 1)
      : mounting_(mounting) {
    sim::PerfectView perfect;
    sim::render(scene, camera_, mounting.T_base_optical(), perfect);
    surfaces_ = std::move(perfect.surfaces);
    sim::Random random(seed);
    sim::measure(perfect.depths, sim::DepthNoise{}, random, image_);
  }

  DepthView view() const {
    DepthBytes bytes{};
    bytes.width = bytes.info_width = camera_.width;
    bytes.height = bytes.info_height = camera_.height;
    bytes.step = camera_.width * 2;
    bytes.encoding = "16UC1";
    bytes.data = reinterpret_cast<const std::uint8_t*>(image_.data());
    bytes.size = image_.size() * 2;
    bytes.intrinsics = camera_.intrinsics;
    return *DepthView::open(bytes);
  }
  Eigen::Isometry3f T_base_optical() const { return mounting_.T_base_optical().cast<float>(); }
  /// What each pixel shows, row by row.
  const std::vector<sim::Surface>& surfaces() const { return surfaces_; }

 private:
  sim::CameraModel camera_;
  sim::Mounting mounting_;
  std::vector<sim::Surface> surfaces_;
  std::vector<std::uint16_t> image_;
};

inline sim::Mounting usualMounting() {
  return {0.65, 26.0 * 0.017453292519943295, 0.0};
}

inline sim::FloorScene emptyFloor() {
  sim::FloorScene scene;
  scene.solids.push_back(sim::makeGround(0.0, sim::Surface::kFloor));
  return scene;
}

inline Eigen::Isometry3d placed(double x, double y) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, y, 0.0);
  return T;
}

}  // namespace pilothouse
