// The real floor nodelets in a loader in this process, with rendered pictures before them.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>

#include "core/floor/floor_cells.hpp"
#include "doors/message_views.hpp"
#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

bool isDrivable(const FloorGrid& grid, std::size_t i) {
  return isDrivable(static_cast<CellClass>(grid.classes[i]));
}

/// Checks a grid against the scene: the box is there, the floor before and beside it is free.
void expectBox(const FloorGrid& grid, const BoxScene& scene) {
  int box = 0, box_found = 0, free = 0, free_found = 0;
  for (std::uint32_t iy = 0; iy < grid.info.height; ++iy) {
    for (std::uint32_t ix = 0; ix < grid.info.width; ++ix) {
      const double half = 0.5 * grid.info.resolution;
      const double x = grid.info.origin.position.x + (2 * ix + 1) * half;
      const double y = grid.info.origin.position.y + (2 * iy + 1) * half;
      const std::size_t i = std::size_t{iy} * grid.info.width + ix;
      const bool in_x = x - half >= scene.low.x() && x + half <= scene.high.x();
      const bool in_y = y - half >= scene.low.y() && y + half <= scene.high.y();
      if (in_x && in_y) {
        ++box;
        if (grid.classes[i] == FloorGrid::OBSTACLE) ++box_found;
      } else if (x > 0.75 && x < 1.1 && std::abs(y) < 0.3) {
        ++free;
        if (isDrivable(grid, i)) ++free_found;
      }
    }
  }
  EXPECT_GT(box, 20);
  EXPECT_GE(box_found, box * 9 / 10);
  EXPECT_GT(free, 50);
  EXPECT_EQ(free_found, free);
}

class FloorNodelet : public testing::TestWithParam<std::string> {
 protected:
  FloorHarness harness_{GetParam()};
  BoxScene scene_;
};

TEST_P(FloorNodelet, SeesTheBoxInEveryOutput) {
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  Inbox<ObjectList> objects(harness_.handle(), "objects/camera");
  Inbox<sensor_msgs::LaserScan> scans(harness_.handle(), "virtual_scan");
  Inbox<sensor_msgs::LaserScan> level_scans(harness_.handle(), "level_scan");
  Inbox<sensor_msgs::PointCloud2> floor_points(harness_.handle(), "floor_points");
  Inbox<sensor_msgs::PointCloud2> obstacle_points(harness_.handle(), "obstacle_points");
  ASSERT_TRUE(harness_.waitForListener());
  double stamp = 100.0;
  // The first pictures may come before the transform or before a listener is connected.
  ASSERT_TRUE(spinUntil([&] {
    harness_.show(scene_, stamp += 0.1);
    return !grids.all().empty() && !objects.all().empty() && !scans.all().empty() &&
           !level_scans.all().empty() && !floor_points.all().empty() &&
           !obstacle_points.all().empty();
  }));

  const FloorGrid& grid = *grids.all()[0];
  EXPECT_EQ(grid.header.frame_id, "base_link");
  expectBox(grid, scene_);

  int nearest = 0;
  for (const Object& object : objects.all()[0]->objects) {
    if (!object.nearest_in_row) continue;
    ++nearest;
    EXPECT_NEAR(object.position.x, scene_.low.x() + 0.025, 0.051);
  }
  EXPECT_GE(nearest, 8) << "lanes that lead to a box 40 cm wide";

  for (const auto& scan : {scans.all()[0], level_scans.all()[0]}) {
    EXPECT_EQ(scan->header.frame_id, "base_link");
    const long ahead = std::lround(-scan->angle_min / scan->angle_increment);
    EXPECT_NEAR(scan->ranges[static_cast<std::size_t>(ahead)], scene_.low.x(), 0.06);
  }

  const Eigen::Isometry3f T_base_camera = BoxScene::T_base_optical().cast<float>();
  const auto obstacle_view = openView(*obstacle_points.all()[0]);
  ASSERT_TRUE(obstacle_view) << obstacle_view.reason();
  ASSERT_GT(obstacle_view->width(), 500U);
  for (std::uint32_t i = 0; i < obstacle_view->width(); ++i) {
    const Eigen::Vector3f p = T_base_camera * obstacle_view->point(0, i);
    EXPECT_NEAR(p.x(), 1.35, 0.16);
    EXPECT_NEAR(p.y(), 0.0, 0.21);
  }
  const auto floor_view = openView(*floor_points.all()[0]);
  ASSERT_TRUE(floor_view) << floor_view.reason();
  ASSERT_GT(floor_view->width(), 10000U);
  for (std::uint32_t i = 0; i < floor_view->width(); ++i) {
    EXPECT_NEAR((T_base_camera * floor_view->point(0, i)).z(), 0.0, 0.03);
  }
}

TEST_P(FloorNodelet, ListensOnlyWhileSomebodyListensToIt) {
  ASSERT_TRUE(harness_.load());
  ASSERT_TRUE(harness_.waitForDiagnostic("input", "message", "idle: nobody listens"));
  EXPECT_EQ(harness_.input().getNumSubscribers(), 0U);
  {
    Inbox<sensor_msgs::LaserScan> scans(harness_.handle(), "virtual_scan");
    ASSERT_TRUE(harness_.waitForListener());
    Inbox<ObjectList> objects(harness_.handle(), "objects/camera");
    ASSERT_TRUE(spinUntil([&] {
      harness_.show(scene_, 1.0);
      return !objects.all().empty();
    }));
    scans.shutdown();
    harness_.show(scene_, 1.0);
    ASSERT_TRUE(objects.waitFor(objects.all().size() + 1)) << "one listener is left";
  }
  EXPECT_TRUE(spinUntil([&] { return harness_.input().getNumSubscribers() == 0; }));
  EXPECT_TRUE(harness_.waitForDiagnostic("input", "message", "idle: nobody listens"));
}

TEST_P(FloorNodelet, RejectsAPictureWithoutATransformNamingTheFrames) {
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  ASSERT_TRUE(harness_.waitForListener());
  scene_.frame = "nowhere";
  harness_.show(scene_, 1.0);
  ASSERT_TRUE(harness_.waitForDiagnostic("input", "rejected: mounting", "1"));
  const std::string reason = harness_.diagnostic("input", "last rejection");
  EXPECT_EQ(reason.find("no transform from \"nowhere\" to \"base_link\""), 0U) << reason;
  EXPECT_TRUE(grids.all().empty());
  EXPECT_EQ(harness_.diagnostic("input", "accepted"), "0");
}

TEST_P(FloorNodelet, FindsTheMountingInThePictureWhenAskedTo) {
  harness_.set("floor/mounting_source", "search");
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  ASSERT_TRUE(harness_.waitForListener());
  scene_.frame = "nowhere";
  harness_.show(scene_, 1.0);
  ASSERT_TRUE(grids.waitFor(1));
  expectBox(*grids.all()[0], scene_);
}

TEST_P(FloorNodelet, StartsAfreshWhenTimeJumpsBack) {
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  ASSERT_TRUE(harness_.waitForListener());
  double stamp = 1000.0;
  const auto judged = [&] {
    return !grids.all().empty() && grids.all().back()->header.stamp == ros::Time(stamp);
  };
  ASSERT_TRUE(spinUntil([&] {  // the first pictures may come before the transform
    harness_.show(scene_, stamp += 0.1);
    return spinUntil(judged, 1.0);
  }));
  while (grids.all().size() < 20) {
    harness_.show(scene_, stamp += 0.1);
    ASSERT_TRUE(spinUntil(judged));
  }
  ASSERT_TRUE(spinUntil([&] {
    return !harness_.diagnostic("mounting", "frames").empty() &&
           std::stoi(harness_.diagnostic("mounting", "frames")) >= 20;
  }));
  EXPECT_EQ(harness_.diagnostic("input", "time jumps"), "0");

  const std::size_t before = grids.all().size();
  harness_.show(scene_, 500.0);
  ASSERT_TRUE(grids.waitFor(before + 1)) << "the very next picture must be judged";
  EXPECT_EQ(grids.all().back()->header.stamp, ros::Time(500.0));
  expectBox(*grids.all().back(), scene_);
  ASSERT_TRUE(harness_.waitForDiagnostic("input", "time jumps", "1"));
  ASSERT_TRUE(harness_.waitForDiagnostic("mounting", "frames", "1"))
      << "what was learnt before the jump must be forgotten";
}

TEST_P(FloorNodelet, LivesThroughTheLatestStampThatAMessageCanCarry) {
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  ASSERT_TRUE(harness_.waitForListener());
  const auto judged = [&](double stamp) {
    return spinUntil([&] {
      harness_.show(scene_, stamp);
      return !grids.all().empty() && grids.all().back()->header.stamp == ros::Time(stamp);
    });
  };
  ASSERT_TRUE(judged(100.0));
  EXPECT_TRUE(judged(4294967295.0));
  EXPECT_TRUE(judged(101.0)) << "a clock that was wrong once must not stop the floor";
}

TEST_P(FloorNodelet, TheRobotsFileGoesBeforeDefaultsAndPrivateNamesBeforeIt) {
  harness_.set("robot/floor/range", 2.0);
  harness_.set("robot/floor/cell_size", 0.25);
  harness_.set("floor/cell_size", 0.1);
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  ASSERT_TRUE(harness_.waitForListener());
  ASSERT_TRUE(spinUntil([&] {
    harness_.show(scene_, 1.0);
    return !grids.all().empty();
  }));
  EXPECT_FLOAT_EQ(grids.all()[0]->info.resolution, 0.1F);
  EXPECT_EQ(grids.all()[0]->info.width, 18U);
  EXPECT_EQ(grids.all()[0]->info.height, 50U);
}

bool reconfigure(FloorHarness& harness, const std::map<std::string, double>& values,
                 dynamic_reconfigure::Config& answer) {
  dynamic_reconfigure::Reconfigure call;
  for (const auto& value : values) {
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = value.first;
    parameter.value = value.second;
    call.request.config.doubles.push_back(parameter);
  }
  const bool done = ros::service::call(harness.name() + "/set_parameters", call);
  answer = call.response.config;
  return done;
}

double valueOf(const dynamic_reconfigure::Config& config, const std::string& key) {
  for (const auto& entry : config.doubles) {
    if (entry.name == key) return entry.value;
  }
  return std::nan("");
}

TEST_P(FloorNodelet, TakesSoundLiveChangesAndRefusesWrongCombinations) {
  ASSERT_TRUE(harness_.load());
  Inbox<FloorGrid> grids(harness_.handle(), "floor_grid");
  ASSERT_TRUE(harness_.waitForListener());
  dynamic_reconfigure::Config answer;
  ASSERT_TRUE(reconfigure(harness_, {{"cell_size", 0.1}}, answer));
  EXPECT_EQ(valueOf(answer, "cell_size"), 0.1);
  ASSERT_TRUE(spinUntil([&] {
    harness_.show(scene_, 1.0);
    return !grids.all().empty();
  }));
  EXPECT_FLOAT_EQ(grids.all().back()->info.resolution, 0.1F);

  ASSERT_TRUE(reconfigure(harness_, {{"threshold_deviation", 0.4}, {"cell_size", 0.2}}, answer));
  EXPECT_EQ(valueOf(answer, "threshold_deviation"), 0.008) << "the old values are reported back";
  EXPECT_EQ(valueOf(answer, "cell_size"), 0.1) << "nothing of a refused set is taken";
  ASSERT_TRUE(reconfigure(harness_, {{"range", std::nan("")}}, answer));
  EXPECT_EQ(valueOf(answer, "range"), 4.0);
  double kept = 0.0;
  ASSERT_TRUE(harness_.handle().getParam("floor/cell_size", kept));
  EXPECT_EQ(kept, 0.1);
  const std::size_t before = grids.all().size();
  harness_.show(scene_, 2.0);
  ASSERT_TRUE(grids.waitFor(before + 1));
  EXPECT_FLOAT_EQ(grids.all().back()->info.resolution, 0.1F);
}

TEST_P(FloorNodelet, IsUnloadedWhilePicturesArrive) {
  for (int round = 0; round < 10; ++round) {
    FloorHarness harness(GetParam());
    ASSERT_TRUE(harness.load());
    Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
    ASSERT_TRUE(harness.waitForListener());
    ASSERT_TRUE(spinUntil([&] {
      for (int i = 0; i < 5; ++i) harness.show(scene_, 1.0);
      return !grids.all().empty();
    }));
    harness.show(scene_, 1.0);  // on its way while the loader goes
  }
}

INSTANTIATE_TEST_SUITE_P(Both, FloorNodelet, testing::Values("DepthFloor", "CloudFloor"),
                         [](const auto& info) { return info.param; });

// ---- malformed input

template <class M, class Spoil>
void publishSpoilt(FloorHarness& harness, boost::shared_ptr<M> message, Spoil spoil) {
  spoil(*message);
  harness.publish(message);
}

TEST(DepthFloor, CountsMalformedImagesAndLives) {
  FloorHarness harness("DepthFloor");
  const BoxScene scene;
  ASSERT_TRUE(harness.load());
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  ASSERT_TRUE(harness.waitForListener());
  harness.publish(scene.info(1.0));
  using sensor_msgs::Image;
  int sent = 0;
  const auto spoilt = [&](auto spoil) {
    publishSpoilt(harness, scene.image(1.0), spoil);
    ++sent;
    return harness.waitForDiagnostic("input", "rejected", std::to_string(sent));
  };
  EXPECT_TRUE(spoilt([](Image& i) { i.data.resize(100); }));
  EXPECT_NE(harness.diagnostic("input", "message"), "running");
  EXPECT_TRUE(spoilt([](Image& i) { i.encoding = "rgb8"; }));
  EXPECT_TRUE(spoilt([](Image& i) { i.step = 1; }));
  EXPECT_TRUE(spoilt([](Image& i) { i.data.clear(); }));
  EXPECT_EQ(harness.diagnostic("input", "rejected: message"), "4");
  ASSERT_TRUE(spinUntil([&] {
    harness.show(scene, 2.0);
    return !grids.all().empty();
  }));
  expectBox(*grids.all()[0], scene);
}

TEST(DepthFloor, CountsImagesThatNoCameraInfoFits) {
  FloorHarness harness("DepthFloor");
  const BoxScene scene;
  ASSERT_TRUE(harness.load());
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  ASSERT_TRUE(harness.waitForListener());
  double stamp = 1.0;
  EXPECT_TRUE(spinUntil([&] {  // of two that come at once only the newer may be kept
    harness.publish(scene.image(stamp += 0.1));
    return !harness.diagnostic("input", "rejected: no camera info").empty();
  }));
  EXPECT_TRUE(grids.all().empty());
}

TEST(CloudFloor, CountsMalformedCloudsAndLives) {
  FloorHarness harness("CloudFloor");
  const BoxScene scene;
  ASSERT_TRUE(harness.load());
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  ASSERT_TRUE(harness.waitForListener());
  using sensor_msgs::PointCloud2;
  int sent = 0;
  const auto spoilt = [&](auto spoil) {
    publishSpoilt(harness, scene.cloud(1.0), spoil);
    ++sent;
    return harness.waitForDiagnostic("input", "rejected: message", std::to_string(sent));
  };
  EXPECT_TRUE(spoilt([](PointCloud2& c) { c.data.resize(100); }));
  EXPECT_TRUE(spoilt([](PointCloud2& c) { c.fields[2].offset = 4000000000U; }));
  EXPECT_TRUE(spoilt([](PointCloud2& c) { c.row_step = 1; }));
  EXPECT_TRUE(spoilt([](PointCloud2& c) { c.width = c.height = 0xFFFFFFFFU; }));
  EXPECT_TRUE(spoilt([](PointCloud2& c) { c.fields.clear(); }));
  EXPECT_TRUE(spoilt([](PointCloud2& c) { c.fields.resize(1000); }));
  ASSERT_TRUE(spinUntil([&] {
    harness.show(scene, 2.0);
    return !grids.all().empty();
  }));
  expectBox(*grids.all()[0], scene);
}

TEST(CloudFloor, SilenceIsAnError) {
  FloorHarness harness("CloudFloor");
  harness.set("floor/input_timeout", 0.2);
  ASSERT_TRUE(harness.load());
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  EXPECT_TRUE(spinUntil([&] {
    return harness.diagnostic("input", "message").find("no input for") == 0 &&
           harness.diagnostic("input", "level") == "2";
  }));
}

TEST(CloudFloor, WarnsWhenTheCameraIsNotMountedAsConfigured) {
  FloorHarness harness("CloudFloor");
  BoxScene scene;
  scene.frame = "tilted";
  tf2_ros::StaticTransformBroadcaster broadcaster;
  Eigen::Isometry3d T_tilted = BoxScene::T_base_optical();
  T_tilted.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()));  // 2.9 degrees of pitch
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_tilted);
  transform.header.frame_id = "base_link";
  transform.child_frame_id = scene.frame;
  broadcaster.sendTransform(transform);
  ASSERT_TRUE(harness.load());
  Inbox<FloorGrid> grids(harness.handle(), "floor_grid");
  ASSERT_TRUE(harness.waitForListener());
  double stamp = 1.0;
  EXPECT_TRUE(spinUntil([&] {
    harness.show(scene, stamp += 0.1);
    return harness.diagnostic("mounting", "level") == "1";
  }));
  ASSERT_FALSE(harness.diagnostic("mounting", "pitch error [deg]").empty());
  EXPECT_NEAR(std::abs(std::stod(harness.diagnostic("mounting", "pitch error [deg]"))), 2.865, 0.3);
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_floor_nodelets");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  const auto camera = pilothouse::broadcastCamera();
  return RUN_ALL_TESTS();
}
