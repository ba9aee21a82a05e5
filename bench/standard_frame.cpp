#include "bench/standard_frame.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/depth_noise.hpp"
#include "sim/random.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kPitch = 26.0 * M_PI / 180.0;
constexpr double kWallX = 6.0;  // [m]

Eigen::Isometry3d at(double x, double y, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(x, y, 0.0));
  T.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return T;
}

sim::FloorScene standardScene() {
  using sim::makeBox;
  using sim::Surface;
  sim::FloorScene scene;
  scene.solids = {sim::makeGround(0.0, Surface::kFloor),
                  makeBox(at(1.6, 0.3, 0.4), {0.3, 0.4, 0.18}, Surface::kBox18cm),
                  makeBox(at(2.6, -0.7, -0.3), {0.3, 0.4, 0.18}, Surface::kBox18cm),
                  makeBox(at(1.3, -0.4, 0.2), {0.2, 0.3, 0.07}, Surface::kBox7cm),
                  makeBox(at(2.2, 0.9, 0.9), {0.2, 0.3, 0.07}, Surface::kBox7cm),
                  makeBox(at(kWallX + 0.5, 0.0, 0.0), {1.0, 30.0, 3.0}, Surface::kObstacle)};
  return scene;
}

}  // namespace

StandardFrame::StandardFrame() {
  sim::Mounting mounting;
  mounting.pitch = kPitch;
  const Eigen::Isometry3d T = mounting.T_base_optical();
  T_base_optical_ = T.cast<float>();
  sim::PerfectView perfect;
  sim::render(standardScene(), camera_, T, perfect);
  sim::Random random(1);
  sim::measure(perfect.depths, sim::DepthNoise{}, random, depth_);

  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Intrinsics& k = camera_.intrinsics;
  for (std::uint32_t v = 0; v < camera_.height; ++v) {
    for (std::uint32_t u = 0; u < camera_.width; ++u) {
      const std::uint16_t millimetres = depth_[std::size_t{v} * camera_.width + u];
      const double z = 0.001 * millimetres;
      Eigen::Vector3f p(static_cast<float>((u - k.cx) / k.fx * z),
                        static_cast<float>((v - k.cy) / k.fy * z), static_cast<float>(z));
      if (millimetres == 0) p.setConstant(kNan);
      if (millimetres != 0) valid_points_.push_back(p);
      cloud16_.insert(cloud16_.end(), {p.x(), p.y(), p.z(), 0.0F});
      cloud32_.insert(cloud32_.end(), {p.x(), p.y(), p.z(), 1.0F, 0.0F, 0.0F, 0.0F, 0.0F});
    }
  }
}

DepthView StandardFrame::depth() const {
  const auto view =
      DepthView::open({camera_.width, camera_.height, camera_.width * 2, "16UC1", false,
                       reinterpret_cast<const std::uint8_t*>(depth_.data()), depth_.size() * 2,
                       camera_.width, camera_.height, camera_.intrinsics});
  if (!view) throw std::logic_error(view.reason());
  return *view;
}

CloudView StandardFrame::cloud(const std::vector<float>& words, std::uint32_t point_step) const {
  static const CloudField fields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
  const auto view = CloudView::open(
      {camera_.width, camera_.height, point_step, camera_.width * point_step, false, fields, 3,
       reinterpret_cast<const std::uint8_t*>(words.data()), words.size() * sizeof(float)});
  if (!view) throw std::logic_error(view.reason());
  return *view;
}

}  // namespace pilothouse::bench
