#include "core/floor/mounting_calibrator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/floor/floor_surface.hpp"
#include "core/floor/plane_search.hpp"

namespace pilothouse {
namespace {

constexpr double kReach = 1.2;  // floor used beyond the nearest cell [m]
// Residuals beyond the gate weigh nothing; the first round takes all [m].
constexpr std::array<double, 5> kGates = {1e3, 0.03, 0.015, 0.008, 0.008};
constexpr int kFewestCells = 60;
constexpr int kFramesToTrust = 5;
constexpr double kSlowest = 1.0 / 60.0;  // weight of a new frame once settled

/// Robust plane through floor cells near the robot; false where there are too few.
bool fitPlane(const std::vector<Eigen::Vector3f>& cells, FloorSlope& plane) {
  for (const double gate : kGates) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    int used = 0;
    for (const Eigen::Vector3f& cell : cells) {
      const Eigen::Vector3d v(1.0, cell.x(), cell.y());
      const double h = cell.z();
      const double t = (h - plane.at(v.y(), v.z())) / gate;
      if (std::abs(t) >= 1.0) continue;
      const double w = (1.0 - t * t) * (1.0 - t * t);  // Tukey's biweight
      a += (w * v) * v.transpose();
      b += (w * h) * v;
      ++used;
    }
    if (used < kFewestCells) return false;
    const Eigen::Vector3d solution = a.ldlt().solve(b);
    if (!solution.allFinite()) return false;
    plane = FloorSlope{solution[0], solution[1], solution[2]};
  }
  return true;
}

}  // namespace

void MountingCalibrator::reset() {
  up_.setZero();
  height_ = 0.0;
  estimate_ = MountingEstimate{};
}

Eigen::Isometry3f MountingCalibrator::corrected(const Eigen::Isometry3f& T_base_optical) const {
  if (!estimate_.valid) return T_base_optical;
  const Eigen::Matrix3d configured = T_base_optical.linear().cast<double>();
  // The smallest turn that makes the floor seen level keeps the yaw.
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(configured * up_, Eigen::Vector3d::UnitZ());
  Eigen::Isometry3f T = T_base_optical;
  T.linear() = (turn.toRotationMatrix() * configured).cast<float>();
  T.translation().z() = static_cast<float>(height_);
  return T;
}

void MountingCalibrator::gatherNearFloor(const FloorGrid& grid) {
  const GridGeometry& g = grid.geometry;
  near_floor_.clear();
  near_floor_.reserve(g.cells());
  int nearest = g.size_x;
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < nearest; ++ix) {
      if (grid.classes[g.index(ix, iy)] == CellClass::kFloor) nearest = ix;
    }
  }
  const int end = std::min(g.size_x, nearest + static_cast<int>(std::lround(kReach / g.cell_size)));
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = nearest; ix < end; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (grid.classes[i] != CellClass::kFloor) continue;
      near_floor_.emplace_back(g.centreX(ix), g.centreY(iy), grid.heights[i]);
    }
  }
}

void MountingCalibrator::add(const FloorGrid& grid, const Eigen::Isometry3f& T_used,
                             const Eigen::Isometry3f& T_configured) {
  gatherNearFloor(grid);
  FloorSlope plane;
  if (!fitPlane(near_floor_, plane)) return;
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
