#include "core/floor/mounting_calibrator.hpp"

#include <algorithm>
#include <cmath>

#include "core/floor/plane_search.hpp"

namespace pilothouse {
namespace {

constexpr int kFramesToTrust = 5;
constexpr double kSlowest = 1.0 / 60.0;  // weight of a new frame once settled

}  // namespace

void MountingCalibrator::reset() {
  up_.setZero();
  height_ = 0.0;
  estimate_ = MountingEstimate{};
}

Eigen::Isometry3f MountingCalibrator::corrected(const Eigen::Isometry3f& T_base_optical) const {
  if (!estimate_.valid) return T_base_optical;
  FloorPlane plane;
  plane.normal = up_.cast<float>();
  plane.height = static_cast<float>(height_);
  Eigen::Isometry3f T = mountingFromPlane(plane);
  // The floor does not show where the camera looks to: its heading stays.
  const Eigen::Vector3f view = T_base_optical.linear().col(2);
  if (view.head<2>().norm() > 0.05F) {
    const float yaw = std::atan2(view.y(), view.x());
    T.linear() = Eigen::AngleAxisf(yaw, Eigen::Vector3f::UnitZ()) * T.linear();
  } else {
    const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(
        T_base_optical.linear() * plane.normal, Eigen::Vector3f::UnitZ());
    T.linear() = turn.toRotationMatrix() * T_base_optical.linear();
  }
  T.translation().head<2>() = T_base_optical.translation().head<2>();
  return T;
}

void MountingCalibrator::add(const FloorSlope& plane, const Eigen::Isometry3f& T_used,
                             const Eigen::Isometry3f& T_configured) {
  const double norm =
      std::sqrt(1.0 + plane.slope_x * plane.slope_x + plane.slope_y * plane.slope_y);
  const Eigen::Vector3d normal = Eigen::Vector3d(-plane.slope_x, -plane.slope_y, 1.0) / norm;
  const Eigen::Vector3d up = T_used.linear().cast<double>().transpose() * normal;
  const Eigen::Vector3d camera = T_used.translation().cast<double>();
  const double height = (camera.z() - plane.at(camera.x(), camera.y())) / norm;

  ++estimate_.frames;
  const double weight = std::max(1.0 / estimate_.frames, kSlowest);
  up_ = (up_ + weight * (up - up_)).normalized();
  height_ += weight * (height - height_);
  estimate_.valid = estimate_.frames >= kFramesToTrust;
  describe(T_configured);
}

void MountingCalibrator::describe(const Eigen::Isometry3f& T_configured) {
  const Eigen::Vector3d up = T_configured.linear().cast<double>().transpose().col(2);
  estimate_.height = height_;
  estimate_.pitch = pitchOf(up_);
  estimate_.roll = rollOf(up_);
  estimate_.height_error = height_ - static_cast<double>(T_configured.translation().z());
  estimate_.pitch_error = estimate_.pitch - pitchOf(up);
  estimate_.roll_error = std::remainder(estimate_.roll - rollOf(up), 2.0 * M_PI);
}

}  // namespace pilothouse
