#include "sim/floor_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pilothouse::sim {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A face as a row of pixels sees it: the ray of column x (in units of the focal length) is within
/// the face's half space for depths t with t * (base + along * x) <= margin.
struct RowFace {
  double margin;
  double base;
  double along;
};

struct PixelBox {
  int u_begin, u_end, v_begin, v_end;
};

/// Pixels that a solid can touch.
PixelBox pixelsOf(const Solid& solid, const CameraModel& camera,
                  const Eigen::Isometry3d& T_optical_base) {
  const int width = static_cast<int>(camera.width);
  const int height = static_cast<int>(camera.height);
  const PixelBox all{0, width, 0, height};
  if (solid.bounds.isEmpty()) return all;
  const Intrinsics& k = camera.intrinsics;
  double u_low = kFar, u_high = -kFar, v_low = kFar, v_high = -kFar;
  for (int i = 0; i < 8; ++i) {
    const auto corner = solid.bounds.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    const Eigen::Vector3d p = T_optical_base * (solid.T_base_solid * corner);
    if (p.z() < 0.05) return all;
    u_low = std::min(u_low, k.cx + k.fx * p.x() / p.z());
    u_high = std::max(u_high, k.cx + k.fx * p.x() / p.z());
    v_low = std::min(v_low, k.cy + k.fy * p.y() / p.z());
    v_high = std::max(v_high, k.cy + k.fy * p.y() / p.z());
  }
  const auto clamped = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  return {clamped(std::floor(u_low) - 1.0, width), clamped(std::ceil(u_high) + 2.0, width),
          clamped(std::floor(v_low) - 1.0, height), clamped(std::ceil(v_high) + 2.0, height)};
}

Surface surfaceAt(const Solid& solid, const Solid::Face& face, const Eigen::Vector3d& p_base) {
  if (face.surface == Surface::kRamp) {
    return p_base.z() > kDrivableStep ? Surface::kRamp : Surface::kRampFoot;
  }
  if (!face.by_height) return face.surface;
  const double x = (solid.T_base_solid.inverse() * p_base).x();
  const double step = std::min(solid.top, solid.slope * x);
  if (step <= kDrivableStep) return Surface::kRampFoot;
  return step < kObstacleStep ? Surface::kBetween : Surface::kObstacle;
}

struct Hit {
  double depth;
  std::size_t face;
};

/// Where the ray of column x enters the solid; depth kFar where it does not.
Hit enter(const std::vector<RowFace>& faces, double x) {
  double near = 0.0, far = kFar;
  std::size_t face = faces.size();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double rate = faces[i].base + faces[i].along * x;
    if (rate < 0.0) {
      const double t = faces[i].margin / rate;
      if (t > near) {
        near = t;
        face = i;
      }
    } else if (rate > 0.0) {
      far = std::min(far, faces[i].margin / rate);
    } else if (faces[i].margin < 0.0) {
      return {kFar, faces.size()};
    }
    if (near >= far) return {kFar, faces.size()};
  }
  return face < faces.size() ? Hit{near, face} : Hit{kFar, face};
}

void renderSolid(const Solid& solid, const CameraModel& camera,
                 const Eigen::Isometry3d& T_base_optical, PerfectView& view) {
  const PixelBox box = pixelsOf(solid, camera, T_base_optical.inverse());
  const Eigen::Matrix3d R = T_base_optical.linear();
  const Eigen::Vector3d eye = T_base_optical.translation();
  const Intrinsics& k = camera.intrinsics;
  std::vector<RowFace> faces(solid.faces.size());
  for (int v = box.v_begin; v < box.v_end; ++v) {
    const Eigen::Vector3d middle = R.col(2) + R.col(1) * ((v - k.cy) / k.fy);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const Eigen::Vector3d normal = solid.T_base_solid.linear() * solid.faces[i].normal;
      const double offset = solid.faces[i].offset + normal.dot(solid.T_base_solid.translation());
      faces[i] = {offset - normal.dot(eye), normal.dot(middle), normal.dot(R.col(0))};
    }
    const std::size_t row = static_cast<std::size_t>(v) * camera.width;
    for (int u = box.u_begin; u < box.u_end; ++u) {
      const double x = (u - k.cx) / k.fx;
      const Hit hit = enter(faces, x);
      const std::size_t i = row + static_cast<std::size_t>(u);
      if (!(hit.depth < 1e3)) continue;
      if (view.depths[i] > 0.0F && hit.depth >= static_cast<double>(view.depths[i])) continue;
      view.depths[i] = static_cast<float>(hit.depth);
      const Eigen::Vector3d p = eye + hit.depth * (middle + R.col(0) * x);
      view.surfaces[i] = surfaceAt(solid, solid.faces[hit.face], p);
    }
  }
}

}  // namespace

Solid makeBox(const Eigen::Isometry3d& T_base_box, const Eigen::Vector3d& size, Surface surface) {
  Solid box;
  box.T_base_solid = T_base_box;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = size[axis] / 2.0;
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    box.faces.push_back({unit, axis == 2 ? size.z() : half, surface});
    box.faces.push_back({-unit, axis == 2 ? 0.0 : half, surface});
  }
  box.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(-size.x() / 2.0, -size.y() / 2.0, 0.0),
                                   Eigen::Vector3d(size.x() / 2.0, size.y() / 2.0, size.z()));
  return box;
}

Solid makeRamp(const Eigen::Isometry3d& T_base_ramp, double angle, double top, double width) {
  constexpr double kLength = 12.0;
  Solid ramp;
  ramp.T_base_solid = T_base_ramp;
  ramp.slope = std::tan(angle);
  ramp.top = top;
  const Eigen::Vector3d up = Eigen::Vector3d(-std::sin(angle), 0.0, std::cos(angle));
  ramp.faces.push_back({up, 0.0, Surface::kRamp});
  ramp.faces.push_back({Eigen::Vector3d::UnitZ(), top, Surface::kRamp});
  ramp.faces.push_back({Eigen::Vector3d::UnitY(), width / 2.0, Surface::kObstacle, true});
  ramp.faces.push_back({-Eigen::Vector3d::UnitY(), width / 2.0, Surface::kObstacle, true});
  ramp.faces.push_back({Eigen::Vector3d::UnitX(), kLength, Surface::kObstacle, true});
  ramp.faces.push_back({-Eigen::Vector3d::UnitZ(), 0.0, Surface::kObstacle});
  ramp.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(0.0, -width / 2.0, 0.0),
                                    Eigen::Vector3d(kLength, width / 2.0, top));
  return ramp;
}

Solid makeGround(double z, Surface surface) {
  Solid ground;
  ground.faces.push_back({Eigen::Vector3d::UnitZ(), z, surface});
  return ground;
}

Solid makeGround(const DropEdge& edge) {
  Solid ground = makeGround(0.0, Surface::kFloor);
  ground.faces.push_back(
      {Eigen::Vector3d(edge.normal.x(), edge.normal.y(), 0.0), edge.offset, Surface::kObstacle});
  return ground;
}

Eigen::Isometry3d Mounting::T_base_optical() const {
  Eigen::Matrix3d R_body_optical;
  R_body_optical << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = height;
  T.linear() = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix() *
               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()).toRotationMatrix() *
               R_body_optical;
  return T;
}

void render(const FloorScene& scene, const CameraModel& camera,
            const Eigen::Isometry3d& T_base_optical, PerfectView& view) {
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  view.depths.assign(pixels, 0.0F);
  view.surfaces.assign(pixels, Surface::kNothing);
  for (const Solid& solid : scene.solids) renderSolid(solid, camera, T_base_optical, view);
}

}  // namespace pilothouse::sim
