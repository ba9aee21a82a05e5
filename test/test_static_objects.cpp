// What keeps its place enters the map and what leaves is cleared: pictures of random scenes through
// the real floor, memory and map.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/floor/floor_segmenter.hpp"
#include "core/mapping/static_objects.hpp"
#include "core/motion/object_merger.hpp"
#include "sim/depth_noise.hpp"
#include "sim/floor_scene.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFrame = 1.0 / 15.0;  // [s]

struct Box {
  Vector2d middle;  ///< map frame [m]
  double heading = 0.0;
  Vector3d size{0.4, 0.4, 0.5};
};

/// A robot that stands or drives in a scene of boxes, and all that its map learns from it.
class Room {
 public:
  explicit Room(std::uint64_t seed, const StaticParameters& parameters = {})
      : random(seed), statics(parameters) {
    sim::Mounting mounting;
    mounting.pitch = 0.45;
    T_base_optical_ = mounting.T_base_optical();
    camera_.width = 320;
    camera_.height = 240;
    camera_.intrinsics = {262.0, 262.0, 159.5, 119.5};
    CameraSight sight;
    sight.T_base_optical = T_base_optical_;
    sight.intrinsics = camera_.intrinsics;
    sight.width = 320;
    sight.height = 240;
    statics.setSight(sight);
  }

  void frame() {
    now += kFrame;
    sim::FloorScene scene;
    scene.solids.push_back(sim::makeGround(0.0, sim::Surface::kFloor));
    for (const Box& box : boxes) {
      const Vector2d p = pose.toBase(box.middle);
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.translate(Vector3d(p.x(), p.y(), 0.0));
      T.rotate(Eigen::AngleAxisd(box.heading - pose.heading, Vector3d::UnitZ()));
      scene.solids.push_back(sim::makeBox(T, box.size, sim::Surface::kObstacle));
    }
    sim::render(scene, camera_, T_base_optical_, view_);
    for (float& depth : view_.depths) {
      if (static_cast<double>(depth) > farthest) depth = 0.0F;
    }
    sim::measure(view_.depths, sim::DepthNoise{}, random, depth_);
    learn();
  }
  void frames(double seconds) {
    for (double t = 0.0; t < seconds; t += kFrame) frame();
  }
  /// Occupied cells of the map within `reach` of a place of it [m].
  int standing(const Vector2d& place, double reach = 0.4) const {
    int count = 0;
    for (double x = -reach; x <= reach; x += 0.05) {
      for (double y = -reach; y <= reach; y += 0.05) {
        const CellPlace cell = map.cellOf(place.x() + x, place.y() + y);
        if (map.at(cell) == MapCell::kOccupied) ++count;
      }
    }
    return count;
  }
  int standing() const {
    MapCells cells;
    map.snapshot(cells);
    return static_cast<int>(std::count(cells.cells.begin(), cells.cells.end(), MapCell::kOccupied));
  }

  sim::Random random;
  std::vector<Box> boxes;
  Pose2 pose;
  double now = 0.0;
  double farthest = 8.0;  ///< what is deeper sends nothing back [m]
  OccupancyMap map{OccupancyParameters{}};
  StaticObjects statics;

 private:
  void learn() {
    DepthBytes bytes{};
    bytes.width = bytes.info_width = 320;
    bytes.height = bytes.info_height = 240;
    bytes.step = 640;
    bytes.encoding = "16UC1";
    bytes.data = reinterpret_cast<const std::uint8_t*>(depth_.data());
    bytes.size = depth_.size() * 2;
    bytes.intrinsics = camera_.intrinsics;
    const FloorCells& grid =
        segmenter_.segment(*DepthView::open(bytes), T_base_optical_.cast<float>());
    const FloorFrame frame{now, grid.geometry, grid.classes.data(), grid.heights.data()};
    merger_.odometry(now, pose, {});
    merger_.floor(frame);
    map.addFloor(frame, pose);
    statics.look(frame, pose, map);
    statics.see(merger_.merge(now).objects, pose, now, map);
  }

  sim::CameraModel camera_;
  Eigen::Isometry3d T_base_optical_;
  sim::PerfectView view_;
  std::vector<std::uint16_t> depth_;
  FloorSegmenter segmenter_{FloorParameters{}};
  ObjectMerger merger_{
      {}, Footprint({{0.25, 0.20}, {-0.25, 0.20}, {-0.25, -0.20}, {0.25, -0.20}}), {}};
};

class StaticObjectsRandom : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  StaticObjectsRandom() : room(GetParam()) {
    room.pose = {room.random.uniform(-5.0, 5.0), room.random.uniform(-5.0, 5.0),
                 room.random.uniform(-3.1, 3.1)};
    Box box;
    box.middle =
        room.pose * Vector2d(room.random.uniform(1.4, 2.4), room.random.uniform(-0.4, 0.4));
    box.heading = room.random.uniform(-3.1, 3.1);
    box.size = {room.random.uniform(0.2, 0.5), room.random.uniform(0.2, 0.5),
                room.random.uniform(0.15, 0.6)};
    room.boxes.push_back(box);
  }
  /// Frames until nothing of the box stands in the map; at most 10.
  int framesUntilCleared() {
    for (int frame = 1; frame <= 10; ++frame) {
      room.frame();
      if (room.standing() == 0) return frame;
    }
    return 99;
  }
  Room room;
};

TEST_P(StaticObjectsRandom, WhatKeepsItsPlaceEntersAfterTheSetTimeAndNotBefore) {
  room.frames(2.5);
  EXPECT_EQ(room.standing(), 0);
  room.frames(2.0);
  EXPECT_GT(room.standing(room.boxes[0].middle, 0.45), 3);
  EXPECT_EQ(room.standing(), room.standing(room.boxes[0].middle, 0.45)) << "and nothing else";
  std::vector<Obstacle> objects;
  room.statics.collect(room.pose, room.map, objects);
  EXPECT_EQ(static_cast<int>(objects.size()), room.standing());
}

TEST_P(StaticObjectsRandom, WhatLeftIsClearedWithinThreeFrames) {
  room.frames(5.0);
  ASSERT_GT(room.standing(), 3);
  room.boxes.clear();
  EXPECT_LE(framesUntilCleared(), 3);
}

// The sensor's reach ends in the box: neither it nor the floor below or behind it sends anything
// back once it is gone.
TEST_P(StaticObjectsRandom, WhatLeftIsClearedAlsoWhenNothingStandsBehind) {
  const Vector2d p = room.pose.toBase(room.boxes[0].middle);
  room.boxes[0].size = {0.4, 0.4, 0.5};
  room.boxes[0].heading = room.pose.heading;
  room.frames(5.0);
  ASSERT_GT(room.standing(), 3);
  const double foot = (p.x() - 0.2) * std::cos(0.45) + 0.65 * std::sin(0.45);
  room.farthest = foot - 0.02;  // depth of the floor along the axis
  room.boxes.clear();
  EXPECT_LE(framesUntilCleared(), 3);
}

TEST_P(StaticObjectsRandom, WhatIsHiddenStays) {
  room.frames(5.0);
  const int before = room.standing(room.boxes[0].middle, 0.45);
  ASSERT_GT(before, 3);
  Box screen;
  const Vector2d p = room.pose.toBase(room.boxes[0].middle);
  screen.middle = room.pose * (0.55 * p);
  screen.heading = room.pose.heading;
  screen.size = {0.1, 3.0, 0.6};
  room.boxes.push_back(screen);
  room.frames(1.0);
  EXPECT_EQ(room.standing(room.boxes[0].middle, 0.45), before);
}

TEST_P(StaticObjectsRandom, WhatIsOutOfViewStays) {
  room.frames(5.0);
  const int before = room.standing();
  ASSERT_GT(before, 3);
  room.boxes.clear();  // unseen
  room.pose.heading += room.random.chance(0.5) ? 1.6 : -1.6;
  room.frames(1.0);
  EXPECT_EQ(room.standing(), before);
}

TEST_P(StaticObjectsRandom, PeopleWhoWalkLeaveNothing) {
  for (int walk = 0; walk < 3; ++walk) {
    const double speed = room.random.uniform(0.3, 1.5);
    const double angle = room.random.uniform(-3.1, 3.1);
    const Vector2d along(std::cos(angle), std::sin(angle));
    const Vector2d through = room.pose * Vector2d(room.random.uniform(1.2, 2.8), 0.0);
    Box& person = room.boxes[0];
    person.size = {0.35, 0.45, 1.7};
    person.heading = angle;
    for (double way = -2.5; way < 2.5; way += speed * kFrame) {
      person.middle = through + way * along;
      if (room.pose.toBase(person.middle).norm() > 0.6) room.frame();
      ASSERT_EQ(room.standing(), 0) << "walking at " << speed << " m/s";
    }
  }
}

TEST_P(StaticObjectsRandom, EntersWhileTheRobotDrivesBy) {
  const Pose2 start = room.pose;
  room.boxes[0].middle = start * Vector2d(2.5, 0.5);
  for (double way = 0.0; way < 1.4; way += 0.25 * kFrame) {
    const Vector2d at = start * Vector2d(way, 0.0);
    room.pose = {at.x(), at.y(), start.heading};
    room.frame();
  }
  EXPECT_GT(room.standing(room.boxes[0].middle, 0.5), 2);
}
INSTANTIATE_TEST_SUITE_P(Seeds, StaticObjectsRandom, ::testing::Range<std::uint64_t>(1, 7));

TEST(StaticObjects, ALongGapDoesNotCountAsBeingThere) {
  OccupancyMap map({});
  StaticObjects statics({});
  Obstacle object;
  object.position = {2.0F, 0.0F};
  statics.see({object}, {}, 1.0, map);
  statics.see({object}, {}, 1000.0, map);
  EXPECT_EQ(map.at(map.cellOf(2.0, 0.0)), MapCell::kUnknown);
}

TEST(StaticObjects, EchoesAndRememberedThingsEnterOnlyWhenAsked) {
  for (const bool echoes : {false, true}) {
    OccupancyMap map({});
    StaticParameters parameters;
    parameters.echoes = echoes;
    StaticObjects statics(parameters);
    Obstacle echo, remembered;
    echo.position = {2.0F, 0.0F};
    echo.source = 1;
    remembered.position = {2.0F, 1.0F};
    remembered.remembered = true;
    for (double t = 0.0; t < 10.0; t += 0.1) statics.see({echo, remembered}, {}, t, map);
    EXPECT_EQ(map.at(map.cellOf(2.0, 0.0)), echoes ? MapCell::kOccupied : MapCell::kUnknown);
    EXPECT_EQ(map.at(map.cellOf(2.0, 1.0)), MapCell::kUnknown);
  }
}

}  // namespace
}  // namespace pilothouse
