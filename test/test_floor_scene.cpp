#include <gtest/gtest.h>

#include <cmath>

#include "sim/floor_scene.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kDegree = 0.017453292519943295;
const CameraModel kCamera;
const Mounting kMounting{0.65, 26.0 * kDegree, 0.0};

std::size_t at(int u, int v) {
  return static_cast<std::size_t>(v) * kCamera.width + static_cast<std::size_t>(u);
}

PerfectView viewOf(const FloorScene& scene, const Mounting& mounting = kMounting) {
  PerfectView view;
  render(scene, kCamera, mounting.T_base_optical(), view);
  return view;
}

Eigen::Isometry3d pose(double x, double y, double yaw) {
  return Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d::Identity();
}

/// Pixel of a point in the base frame.
Eigen::Vector2d project(const Eigen::Vector3d& p, const Mounting& mounting = kMounting) {
  const Eigen::Vector3d q = mounting.T_base_optical().inverse() * p;
  const Intrinsics& k = kCamera.intrinsics;
  return {k.cx + k.fx * q.x() / q.z(), k.cy + k.fy * q.y() / q.z()};
}

Eigen::Vector3d pointAt(const PerfectView& view, int u, int v,
                        const Mounting& mounting = kMounting) {
  const Intrinsics& k = kCamera.intrinsics;
  const double z = static_cast<double>(view.depths[at(u, v)]);
  return mounting.T_base_optical() *
         Eigen::Vector3d((u - k.cx) / k.fx * z, (v - k.cy) / k.fy * z, z);
}

TEST(FloorScene, FloorHasTheDepthOfTheClosedForm) {
  const PerfectView view = viewOf({{makeGround(0.0, Surface::kFloor)}, {}});
  for (const int v : {60, 239, 300, 479}) {
    // A ray of image height y (in focal lengths) sinks by sin p + y cos p for each metre of depth.
    const double y = (v - 239.5) / 525.0;
    const double expected = 0.65 / (std::sin(kMounting.pitch) + y * std::cos(kMounting.pitch));
    for (const int u : {0, 320, 639}) {
      EXPECT_NEAR(view.depths[at(u, v)], expected, 1e-5) << u << ' ' << v;
      EXPECT_EQ(view.surfaces[at(u, v)], Surface::kFloor);
    }
  }
}

TEST(FloorScene, PitchLooksDownAndRollLeansToTheRight) {
  const Eigen::Isometry3d down = Mounting{0.5, 0.1, 0.0}.T_base_optical();
  EXPECT_LT((down.linear() * Eigen::Vector3d::UnitZ()).z(), 0.0);
  const Eigen::Isometry3d leaning = Mounting{0.5, 0.0, 0.1}.T_base_optical();
  EXPECT_LT((leaning.linear() * Eigen::Vector3d::UnitX()).z(), 0.0);
  EXPECT_DOUBLE_EQ(leaning.translation().z(), 0.5);
}

TEST(FloorScene, AboveTheHorizonThereIsNothing) {
  const Mounting level{0.65, 0.0, 0.0};
  const PerfectView view = viewOf({{makeGround(0.0, Surface::kFloor)}, {}}, level);
  EXPECT_EQ(view.depths[at(320, 239)], 0.0F);
  EXPECT_EQ(view.surfaces[at(320, 239)], Surface::kNothing);
  EXPECT_EQ(view.surfaces[at(320, 300)], Surface::kFloor);
}

TEST(FloorScene, BoxCoversExactlyThePixelsBetweenItsEdges) {
  // Its front face is square to the view: 0.4 m wide at x = 1.5, 18 cm high.
  const FloorScene scene{{makeGround(0.0, Surface::kFloor),
                          makeBox(pose(1.6, 0.0, 0.0), {0.2, 0.4, 0.18}, Surface::kBox18cm)},
                         {}};
  const PerfectView view = viewOf(scene);
  const int v = static_cast<int>(project({1.5, 0.0, 0.09}).y());
  const double height = pointAt(view, 320, v).z();
  const double left = project({1.5, 0.2, height}).x();
  const double right = project({1.5, -0.2, height}).x();
  for (int u = 0; u < 640; ++u) {
    if (std::abs(u - left) < 0.1 || std::abs(u - right) < 0.1) continue;
    const Surface expected = u > left && u < right ? Surface::kBox18cm : Surface::kFloor;
    ASSERT_EQ(view.surfaces[at(u, v)], expected) << "column " << u;
  }
  EXPECT_NEAR(pointAt(view, 320, v).x(), 1.5, 1e-5);
  const int foot = static_cast<int>(std::floor(project({1.5, 0.0, 0.0}).y()));
  EXPECT_EQ(view.surfaces[at(320, foot)], Surface::kBox18cm);
  EXPECT_EQ(view.surfaces[at(320, foot + 1)], Surface::kFloor);
  const int back = static_cast<int>(std::ceil(project({1.7, 0.0, 0.18}).y()));
  EXPECT_EQ(view.surfaces[at(320, back)], Surface::kBox18cm);
  EXPECT_EQ(view.surfaces[at(320, back - 1)], Surface::kFloor);
  EXPECT_NEAR(pointAt(view, 320, back).z(), 0.18, 1e-5);
}

TEST(FloorScene, TurnedBoxHasItsPointsOnItsFaces) {
  const Eigen::Isometry3d T = pose(1.4, -0.2, 0.6);
  const FloorScene scene{{makeBox(T, {0.3, 0.2, 0.07}, Surface::kBox7cm)}, {}};
  const PerfectView view = viewOf(scene);
  int hits = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (view.surfaces[at(u, v)] == Surface::kNothing) continue;
      ++hits;
      const Eigen::Vector3d p = T.inverse() * pointAt(view, u, v);
      const double off = std::min({std::abs(std::abs(p.x()) - 0.15),
                                   std::abs(std::abs(p.y()) - 0.1), std::abs(p.z() - 0.07)});
      ASSERT_LT(off, 1e-5);
      ASSERT_LT(std::abs(p.x()), 0.15 + 1e-5);
      ASSERT_LT(std::abs(p.y()), 0.1 + 1e-5);
    }
  }
  EXPECT_GT(hits, 5000);
}

TEST(FloorScene, RampRisesFromAFlushEdgeToALevelTop) {
  const double angle = 8.0 * kDegree;
  const FloorScene scene{
      {makeGround(0.0, Surface::kFloor), makeRamp(pose(1.0, 0.0, 0.0), angle, 0.2, 12.0)}, {}};
  const PerfectView view = viewOf(scene);
  for (int v = 60; v < 480; ++v) {
    const Eigen::Vector3d p = pointAt(view, 320, v);
    const double expected = std::clamp(std::tan(angle) * (p.x() - 1.0), 0.0, 0.2);
    ASSERT_NEAR(p.z(), expected, 1e-5) << "row " << v << " x " << p.x();
    const Surface surface = view.surfaces[at(320, v)];
    if (p.x() < 0.999) {
      EXPECT_EQ(surface, Surface::kFloor);
    }
    if (p.x() > 1.001 && p.z() < kDrivableStep - 1e-4) {
      EXPECT_EQ(surface, Surface::kRampFoot);
    }
    if (p.z() > kDrivableStep + 1e-4) {
      EXPECT_EQ(surface, Surface::kRamp);
    }
  }
}

TEST(FloorScene, SideOfARampIsCalledByItsHeight) {
  const double slope = std::tan(10.0 * kDegree);
  const FloorScene scene{
      {makeGround(0.0, Surface::kFloor), makeRamp(pose(1.0, 0.8, 0.0), 10.0 * kDegree, 0.4, 0.8)},
      {}};
  const PerfectView view = viewOf(scene);
  int seen[3] = {0, 0, 0};
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector3d p = pointAt(view, u, v);
      if (view.depths[at(u, v)] <= 0.0F || std::abs(p.y() - 0.4) > 1e-5 || p.z() < 1e-4) continue;
      const double step = slope * (p.x() - 1.0);
      if (p.z() > step - 1e-4 || step > 0.39) continue;  // the slope's own edge
      if (step < kDrivableStep - 1e-4) {
        EXPECT_EQ(view.surfaces[at(u, v)], Surface::kRampFoot);
        ++seen[0];
      } else if (step > kDrivableStep + 1e-4 && step < kObstacleStep - 1e-4) {
        EXPECT_EQ(view.surfaces[at(u, v)], Surface::kBetween);
        ++seen[1];
      } else if (step > kObstacleStep + 1e-4) {
        EXPECT_EQ(view.surfaces[at(u, v)], Surface::kObstacle);
        ++seen[2];
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 0);
}

TEST(FloorScene, BeyondADropEdgeTheLowerLevelShowsAfterItsShadow) {
  const DropEdge edge{Eigen::Vector2d(1.0, 0.0), 1.5};
  const FloorScene scene{{makeGround(edge), makeGround(-0.13, Surface::kLowerLevel)}, edge};
  const PerfectView view = viewOf(scene);
  double first_lower = 1e9;
  for (int v = 60; v < 480; ++v) {
    const Eigen::Vector3d p = pointAt(view, 320, v);
    if (view.surfaces[at(320, v)] == Surface::kFloor) {
      EXPECT_LE(p.x(), 1.5 + 1e-6);
      EXPECT_NEAR(p.z(), 0.0, 1e-5);
    } else {
      ASSERT_EQ(view.surfaces[at(320, v)], Surface::kLowerLevel);
      EXPECT_NEAR(p.z(), -0.13, 1e-5);
      first_lower = std::min(first_lower, p.x());
    }
  }
  // By similar triangles: 1.5 m from 0.65 m, carried on by 0.13 m, and at most one row farther.
  EXPECT_GE(first_lower, 1.5 * (0.65 + 0.13) / 0.65 - 1e-6);
  EXPECT_LE(first_lower, 1.83);
}

TEST(FloorScene, TheNearerSolidWinsWhateverTheirOrder) {
  const Solid floor = makeGround(0.0, Surface::kFloor);
  const Solid near = makeBox(pose(1.2, 0.0, 0.3), {0.2, 0.2, 0.3}, Surface::kObstacle);
  const Solid far = makeBox(pose(1.6, 0.1, 0.1), {0.2, 0.4, 0.18}, Surface::kBox18cm);
  const PerfectView a = viewOf({{floor, near, far}, {}});
  const PerfectView b = viewOf({{far, near, floor}, {}});
  EXPECT_EQ(a.surfaces, b.surfaces);
  EXPECT_EQ(a.depths, b.depths);
}

}  // namespace
}  // namespace pilothouse::sim
