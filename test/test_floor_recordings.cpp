// The real floor nodelets on real recordings; skipped where PILOTHOUSE_DATA is not set.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdlib>
#include <fstream>

#include "core/floor/floor_cells.hpp"
#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

/// Path of a recording; empty, with a message, where there is none.
std::string recording(const std::string& name) {
  const char* data = std::getenv("PILOTHOUSE_DATA");
  return data == nullptr ? "" : std::string(data) + "/bags/" + name;
}

struct Shares {
  double known = 0.0;     ///< of the cells in front
  double drivable = 0.0;  ///< of the known
  int obstacles = 0;
};

/// What lies within 0.6 to 2.5 m ahead and 60 cm to either side.
Shares inFront(const FloorGrid& grid) {
  int cells = 0, known = 0, drivable = 0;
  Shares shares;
  for (std::uint32_t i = 0; i < grid.info.width * grid.info.height; ++i) {
    const auto kind = static_cast<CellClass>(grid.classes[i]);
    if (kind == CellClass::kObstacle) ++shares.obstacles;
    const double x =
        grid.info.origin.position.x + (i % grid.info.width + 0.5) * grid.info.resolution;
    const double y =
        grid.info.origin.position.y + (i / grid.info.width + 0.5) * grid.info.resolution;
    if (x < 0.6 || x > 2.5 || std::abs(y) > 0.6) continue;
    ++cells;
    if (kind != CellClass::kUnknown) ++known;
    if (isDrivable(kind)) ++drivable;
  }
  shares.known = cells > 0 ? static_cast<double>(known) / cells : 0.0;
  shares.drivable = known > 0 ? static_cast<double>(drivable) / known : 0.0;
  return shares;
}

/// Every floor grid of a depth recording that brings its own tf.
std::vector<FloorGrid::ConstPtr> judgeDepth(FloorHarness& harness, const std::string& path) {
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  EXPECT_TRUE(harness.waitForListener());
  ros::Publisher tf = harness.handle().advertise<tf2_msgs::TFMessage>("/tf_static", 10, true);
  bool mounted = false;
  rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& entry : rosbag::View(bag)) {
    if (const auto transforms = entry.instantiate<tf2_msgs::TFMessage>()) {
      tf.publish(transforms);
      mounted = true;
      EXPECT_TRUE(spinUntil([&] { return tf.getNumSubscribers() > 0; }));
    } else if (const auto info = entry.instantiate<sensor_msgs::CameraInfo>()) {
      harness.publish(info);
    } else if (const auto image = entry.instantiate<sensor_msgs::Image>()) {
      if (!mounted) continue;
      const auto judged = [&] {
        return !grids.all().empty() && grids.all().back()->header.stamp == image->header.stamp;
      };
      // Until the transform has come in the first is rejected, and shown again.
      EXPECT_TRUE(spinUntil([&] {
        harness.publish(image);
        return spinUntil(judged, grids.all().empty() ? 0.3 : 60.0);
      }));
    }
  }
  return grids.all();
}

TEST(FloorOnRecordings, ACartSeesFloorInFrontAndFurnitureOnIt) {
  const std::string path = recording("realsense_floor_seq_100f.bag");
  if (path.empty()) GTEST_SKIP() << "PILOTHOUSE_DATA is not set: no recordings";
  FloorHarness harness("DepthFloor");
  harness.set("floor/calibrate_mounting", true);
  ASSERT_TRUE(harness.load());
  const auto grids = judgeDepth(harness, path);
  ASSERT_GE(grids.size(), 95U);
  double known = 0.0, drivable = 0.0;
  int with_obstacles = 0;
  for (const auto& grid : grids) {
    const Shares shares = inFront(*grid);
    known += shares.known / static_cast<double>(grids.size());
    drivable += shares.drivable / static_cast<double>(grids.size());
    if (shares.obstacles > 10) ++with_obstacles;
  }
  RecordProperty("known", std::to_string(known));
  RecordProperty("drivable", std::to_string(drivable));
  std::cout << "known " << known << ", drivable of those " << drivable << ", with obstacles "
            << with_obstacles << " of " << grids.size() << '\n';
  EXPECT_GT(known, 0.3);
  EXPECT_GT(drivable, 0.3);
  EXPECT_GT(with_obstacles, static_cast<int>(grids.size() / 2));
}

TEST(FloorOnRecordings, CloudsWithoutTfAreJudgedByTheFloorInThem) {
  const std::string path = recording("kinect_organised_clouds.bag");
  if (path.empty()) GTEST_SKIP() << "PILOTHOUSE_DATA is not set: no recordings";
  FloorHarness harness("CloudFloor");
  harness.set("floor/mounting_source", "search");
  ASSERT_TRUE(harness.load());
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  ASSERT_TRUE(harness.waitForListener());
  ASSERT_TRUE(harness.waitForDiagnostic("input", "arrived", "0"));
  rosbag::Bag bag(path);
  int shown = 0;
  for (const rosbag::MessageInstance& entry : rosbag::View(bag)) {
    const auto cloud = entry.instantiate<sensor_msgs::PointCloud2>();
    if (!cloud) continue;
    harness.publish(cloud);
    ++shown;
    ASSERT_TRUE(harness.waitForDiagnostic("input", "arrived", std::to_string(shown)));
  }
  ASSERT_EQ(shown, 11);
  std::cout << "judged " << grids.all().size() << " of " << shown
            << ", last rejection: " << harness.diagnostic("input", "last rejection") << '\n';
  EXPECT_GE(grids.all().size(), 6U);
  for (const auto& grid : grids.all()) {
    std::cout << "  known " << inFront(*grid).known << ", drivable of those "
              << inFront(*grid).drivable << ", obstacles " << inFront(*grid).obstacles << '\n';
  }
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_floor_recordings");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
