#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "core/cloud/checked.hpp"
#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"

namespace pilothouse {

/// A floor seen from a camera, in its optical frame (x right, y down, z forward).
struct FloorPlane {
  Eigen::Vector3f normal = Eigen::Vector3f(0.0F, -1.0F, 0.0F);  ///< unit, up
  float height = 0.0F;        ///< of the camera above the floor [m]
  float inlier_share = 0.0F;  ///< of the valid points, 0..1
};

/// Which planes can be the floor. Angles of the view axis: pitch positive looks down.
struct PlaneSearchParameters {
  double min_pitch = -0.4;   ///< [rad]
  double max_pitch = 1.3;    ///< [rad]
  double max_roll = 0.6;     ///< [rad], either way
  double min_height = 0.03;  ///< of the camera above the floor [m]
  double max_height = 2.5;   ///< [m]
  double max_depth = 4.0;    ///< farther points are ignored [m]
  double inlier = 0.015;     ///< points this near to the plane belong to it [m]
  double min_share = 0.08;   ///< smallest share of points that makes a floor
  int hypotheses = 1500;
  std::uint64_t seed = 1;  ///< the search is the same for the same seed
};

/// Finds the floor without a known mounting: random planes through three points near each other,
/// the one with the most points on it and the fewest below wins and is refined (RANSAC, Fischler
/// and Bolles 1981; the penalty below keeps table tops from winning over the floor they stand on).
/// Refused, with the reason, where no plane fits.
Checked<FloorPlane> findFloorPlane(const CloudView& cloud,
                                   const PlaneSearchParameters& parameters = {});
Checked<FloorPlane> findFloorPlane(const DepthView& depth,
                                   const PlaneSearchParameters& parameters = {});

/// The mounting that the plane means: base frame below the camera, x where the camera looks.
Eigen::Isometry3f mountingFromPlane(const FloorPlane& plane);

/// Of the view axis [rad]: pitch positive looks down, roll positive leans to the right.
double pitchOf(const Eigen::Vector3d& up_in_optical);
double rollOf(const Eigen::Vector3d& up_in_optical);

}  // namespace pilothouse
