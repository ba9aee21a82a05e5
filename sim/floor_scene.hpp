#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/cloud/depth_view.hpp"

namespace pilothouse::sim {

/// What a ray hit.
enum class Surface : std::uint8_t {
  kNothing = 0,
  kFloor,
  kRamp,      ///< slope above kDrivableStep, and its level top
  kRampFoot,  ///< slope, and sides of a ramp, up to kDrivableStep above the floor
  kSill,
  kBox7cm,
  kBox18cm,
  kObstacle,    ///< boxes of other heights, high sides of ramps
  kBetween,     ///< side of a ramp between kDrivableStep and kObstacleStep: nobody says which it is
  kLowerLevel,  ///< floor beyond a step down
};
constexpr std::size_t kSurfaces = 10;
constexpr double kDrivableStep = 0.02;  ///< a step up to this is drivable [m]
constexpr double kObstacleStep = 0.05;  ///< a step from this on is an obstacle [m]

inline bool isObstacle(Surface s) {
  return s == Surface::kBox7cm || s == Surface::kBox18cm || s == Surface::kObstacle;
}
inline bool isDrivable(Surface s) {
  return s == Surface::kFloor || s == Surface::kRamp || s == Surface::kRampFoot ||
         s == Surface::kSill;
}

/// A convex solid: the points with normal . p <= offset for every face.
struct Solid {
  struct Face {
    Eigen::Vector3d normal;  ///< unit, outward, solid's frame
    double offset;           ///< [m]
    Surface surface;
    bool by_height = false;  ///< side of a ramp: what it is depends on how high the ramp is there
  };
  Eigen::Isometry3d T_base_solid = Eigen::Isometry3d::Identity();
  std::vector<Face> faces;
  Eigen::AlignedBox3d bounds;  ///< solid's frame; empty: unbounded
  double slope = 0.0;          ///< ramp: rise a metre along the solid's x
  double top = 0.0;            ///< ramp: height of its level end [m]
};

/// Box on the ground: origin in the middle of its underside, size [m].
Solid makeBox(const Eigen::Isometry3d& T_base_box, const Eigen::Vector3d& size, Surface surface);
/// Ramp that starts flush with the ground at x = 0 of its frame, rises along x at `angle` [rad] to
/// `top` [m] and goes on level; `width` in y [m], 12 m long. Convex, as a rise that flattens is.
Solid makeRamp(const Eigen::Isometry3d& T_base_ramp, double angle, double top, double width);
/// Endless ground at height z [m].
Solid makeGround(double z, Surface surface);

/// Line on the floor behind which it lies deeper: normal . (x, y) > offset is beyond.
struct DropEdge {
  Eigen::Vector2d normal;  ///< unit, points away from the robot
  double offset;           ///< distance of the edge from the base frame's origin [m]
};
/// Ground at z = 0 that ends at the edge.
Solid makeGround(const DropEdge& edge);

/// Camera body in the base frame, above its origin, as T = Tz(height) Ry(pitch) Rx(roll).
struct Mounting {
  double height = 0.65;  ///< [m]
  double pitch = 0.0;    ///< positive looks down [rad]
  double roll = 0.0;     ///< [rad]
  Eigen::Isometry3d T_base_optical() const;
};

struct CameraModel {
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  Intrinsics intrinsics{525.0, 525.0, 319.5, 239.5};
};

struct FloorScene {
  std::vector<Solid> solids;
  std::optional<DropEdge> edge;
};

/// What a perfect camera sees, row by row.
struct PerfectView {
  std::vector<float> depths;      ///< along the optical axis [m]; 0: nothing hit
  std::vector<Surface> surfaces;  ///< kNothing where the depth is 0
};

/// Casts one ray a pixel, through its centre. Reuses the memory of `view`.
void render(const FloorScene& scene, const CameraModel& camera,
            const Eigen::Isometry3d& T_base_optical, PerfectView& view);

}  // namespace pilothouse::sim
