// What the robot remembers of things that it does not see any more.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/motion/local_memory.hpp"
#include "core/motion/object_merger.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

Footprint outline() {
  return Footprint({{0.25, 0.20}, {-0.25, 0.20}, {-0.25, -0.20}, {0.25, -0.20}});
}

/// A camera that sees x 0.8..3, y -1..1 of the base frame; everything there is free at first.
struct View {
  GridGeometry geometry;
  std::vector<CellClass> classes;
  std::vector<float> heights;

  View() {
    geometry.x_min = 0.8F;
    geometry.y_min = -1.0F;
    geometry.size_x = 44;
    geometry.size_y = 40;
    classes.assign(geometry.cells(), CellClass::kFloor);
    heights.assign(geometry.cells(), 0.0F);
  }
  void put(double x, double y, CellClass kind, float height = 0.3F) {
    const int ix = static_cast<int>(std::floor((x - 0.8) / 0.05));
    const int iy = static_cast<int>(std::floor((y + 1.0) / 0.05));
    if (!geometry.contains(ix, iy)) return;
    classes[geometry.index(ix, iy)] = kind;
    heights[geometry.index(ix, iy)] = height;
  }
  /// A box of 0.2 m whose middle is at a place of the odometry frame, seen from `pose`.
  void putBox(const Pose2& pose, const Vector2d& middle) {
    for (double dx = -0.09; dx < 0.1; dx += 0.03) {
      for (double dy = -0.09; dy < 0.1; dy += 0.03) {
        const Vector2d p = pose.toBase(middle + Vector2d(dx, dy));
        put(p.x(), p.y(), CellClass::kObstacle);
      }
    }
  }
  FloorFrame frame(double stamp) const { return {stamp, geometry, classes.data(), heights.data()}; }
};

std::vector<Obstacle> collected(const LocalMemory& memory, const Pose2& pose, double now) {
  std::vector<Obstacle> objects;
  memory.collect(pose, now, objects);
  return objects;
}

double nearest(const std::vector<Obstacle>& objects) {
  double distance = 1e9;
  for (const auto& object : objects) {
    distance = std::min(distance, static_cast<double>(object.position.norm()));
  }
  return distance;
}

TEST(LocalMemory, KeepsWhatCameNearerThanTheCameraSees) {
  LocalMemory memory({}, outline());
  double now = 0.0;
  for (double x = 0.0; x <= 1.2; x += 0.02, now += 0.033) {
    const Pose2 pose{x, 0.0, 0.0};
    View view;
    view.putBox(pose, {1.8, 0.0});
    memory.drivenOver(pose, now);
    memory.add(view.frame(now), pose);
  }
  const auto objects = collected(memory, {1.2, 0.0, 0.0}, now);
  ASSERT_FALSE(objects.empty());
  EXPECT_TRUE(objects[0].remembered);
  EXPECT_NEAR(nearest(objects), 0.5, 0.06) << "its front stands at 1.7 m of the odometry frame";
}

TEST(LocalMemory, ForgetsWhatIsSeenFreeAgain) {
  LocalMemory memory({}, outline());
  View with, without;
  with.putBox({}, {1.5, 0.0});
  memory.add(with.frame(0.0), {});
  EXPECT_FALSE(collected(memory, {}, 0.0).empty());
  memory.add(without.frame(0.033), {});
  memory.add(without.frame(0.066), {});
  EXPECT_TRUE(collected(memory, {}, 0.066).empty());
}

// A box at the near rim: its front is nearer than the camera sees, only its foot is left, and that
// looks like floor. What stands behind stays hidden.
TEST(LocalMemory, KeepsWhatShowsOnlyItsFoot) {
  LocalMemory memory({}, outline());
  View with, foot;
  with.putBox({}, {1.5, 0.0});
  for (int ix = 0; ix < foot.geometry.size_x; ++ix) {
    for (int iy = 0; iy < foot.geometry.size_y; ++iy) {
      const bool shadow =
          foot.geometry.centreX(ix) > 1.45F && std::abs(foot.geometry.centreY(iy)) < 0.3F;
      if (shadow) foot.classes[foot.geometry.index(ix, iy)] = CellClass::kUnknown;
    }
  }
  memory.add(with.frame(0.0), {});
  for (int i = 1; i < 10; ++i) memory.add(foot.frame(0.033 * i), {});
  EXPECT_NEAR(nearest(collected(memory, {}, 0.4)), 1.42, 0.06) << "its front row";
}

// At the near rim of the view the camera sees no higher than the foot of what stands there; the
// thing's farther rows are still seen as what they are. In the middle of the view the same is floor
// before a thing.
TEST(LocalMemory, KeepsTheFootOfAThingAtTheNearRimOfTheView) {
  for (const float blind : {1.40F, 0.8F}) {
    LocalMemory memory({}, outline());
    View with, foot;
    with.putBox({}, {1.5, 0.0});
    foot.putBox({}, {1.5, 0.0});
    for (int ix = 0; ix < foot.geometry.size_x; ++ix) {
      for (int iy = 0; iy < foot.geometry.size_y; ++iy) {
        CellClass& kind = foot.classes[foot.geometry.index(ix, iy)];
        if (foot.geometry.centreX(ix) < 1.47F) kind = CellClass::kFloor;
        if (foot.geometry.centreX(ix) < blind) kind = CellClass::kUnknown;
      }
    }
    memory.add(with.frame(0.0), {});
    for (int i = 1; i < 10; ++i) memory.add(foot.frame(0.033 * i), {});
    const double first = nearest(collected(memory, {}, 0.4));
    const bool rim = blind > 1.0F;
    EXPECT_NEAR(first, rim ? 1.42 : 1.48, 0.03);
  }
}

TEST(LocalMemory, KeepsWhatIsOnlyHidden) {
  LocalMemory memory({}, outline());
  View with, hidden;
  with.putBox({}, {1.5, 0.0});
  hidden.classes.assign(hidden.classes.size(), CellClass::kUnknown);
  memory.add(with.frame(0.0), {});
  for (int i = 1; i < 30; ++i) memory.add(hidden.frame(0.033 * i), {});
  const auto objects = collected(memory, {}, 1.0);
  ASSERT_FALSE(objects.empty());
  EXPECT_TRUE(objects[0].remembered);
}

TEST(LocalMemory, ForgetsWhatIsTooOld) {
  AvoidanceParameters parameters;
  parameters.memory = 5.0;
  LocalMemory memory(parameters, outline());
  View with, hidden;
  with.putBox({}, {1.5, 0.0});
  hidden.classes.assign(hidden.classes.size(), CellClass::kUnknown);
  memory.add(with.frame(0.0), {});
  memory.add(hidden.frame(0.1), {});
  EXPECT_FALSE(collected(memory, {}, 4.9).empty());
  EXPECT_TRUE(collected(memory, {}, 5.1).empty());
}

TEST(LocalMemory, WhatTheRobotStandsOnIsNotThere) {
  LocalMemory memory({}, outline());
  View view;
  view.putBox({}, {1.5, 0.0});
  memory.add(view.frame(0.0), {});
  memory.add(View().frame(-1.0), {10.0, 0.0, 0.0});  // looks elsewhere
  memory.drivenOver({1.5, 0.0, 0.0}, 0.1);
  EXPECT_TRUE(collected(memory, {1.5, 0.0, 0.0}, 0.2).empty());
}

TEST(LocalMemory, ALoneSpeckleCountsWhenSeenAgainOrNear) {
  LocalMemory memory({}, outline());
  View clean, speckle;
  speckle.put(2.02, 0.02, CellClass::kObstacle);
  memory.add(clean.frame(0.0), {});
  memory.add(speckle.frame(0.1), {});
  EXPECT_TRUE(collected(memory, {}, 0.1).empty()) << "once of three";
  memory.add(speckle.frame(0.2), {});
  EXPECT_EQ(collected(memory, {}, 0.2).size(), 1U) << "twice of three";

  LocalMemory other({}, outline());
  View near;
  near.put(0.82, 0.02, CellClass::kObstacle);  // 0.57 m before the outline
  other.add(near.frame(0.0), {});
  EXPECT_TRUE(collected(other, {}, 0.0).empty());
  EXPECT_EQ(collected(other, {0.1, 0.0, 0.0}, 0.0).size(), 1U) << "0.47 m: at once";
}

TEST(LocalMemory, KnowsWhereItLooked) {
  LocalMemory memory({}, outline());
  memory.add(View().frame(0.0), {});
  memory.drivenOver({}, 0.0);
  EXPECT_TRUE(memory.looked({1.5, 0.5}, 0.1));
  EXPECT_TRUE(memory.looked({0.1, 0.1}, 0.1)) << "it stood there";
  EXPECT_FALSE(memory.looked({-1.0, 0.0}, 0.1));
  EXPECT_FALSE(memory.looked({0.5, 0.0}, 0.1)) << "nearer than the camera sees";
  EXPECT_FALSE(memory.looked({1.5, 0.5}, 1000.0)) << "too long ago";
}

TEST(LocalMemory, IsBoundedHoweverFarTheRobotDrives) {
  LocalMemory memory({}, outline());
  std::size_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose{0.1 * i, 0.05 * i, 0.001 * i};
    View view;
    for (double y = -1.0; y < 1.0; y += 0.05) view.put(1.5, y, CellClass::kObstacle);
    memory.add(view.frame(0.033 * i), pose);
    const auto objects = collected(memory, pose, 0.033 * i);
    for (const auto& object : objects) EXPECT_LT(object.position.norm(), 7.2F);
    most = std::max(most, objects.size());
  }
  EXPECT_LE(most, 40000U);
  EXPECT_GT(most, 0U);
}

TEST(PoseHistory, InterpolatesAndRefuses) {
  PoseHistory history;
  EXPECT_FALSE(history.at(0.0).has_value());
  EXPECT_TRUE(history.add(1.0, {0.0, 0.0, 3.1}, {}));
  EXPECT_TRUE(history.add(2.0, {1.0, 0.0, -3.1}, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(history.add(2.0, {}, {}));
  EXPECT_FALSE(history.add(3.0, {std::nan(""), 0.0, 0.0}, {}));
  const auto middle = history.at(1.5);
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->x, 0.5, 1e-12);
  EXPECT_NEAR(std::abs(middle->heading), M_PI, 1e-3) << "the short way round";
  EXPECT_FALSE(history.at(0.9).has_value());
  EXPECT_TRUE(history.at(2.2).has_value());
  EXPECT_FALSE(history.at(2.4).has_value()) << "too far ahead to know";
}

}  // namespace
}  // namespace pilothouse
