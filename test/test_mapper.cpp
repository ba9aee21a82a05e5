// The real mapping nodelets in this process, fed by hand.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nodelet/loader.h>
#include <pilothouse/MapFile.h>
#include <pilothouse/MapGrid.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/Marker.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "doors/map_views.hpp"
#include "test/floor_harness.hpp"
#include "test/own_folder.hpp"

namespace pilothouse {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A mapper in a namespace of its own, before it a robot that stands in an empty hall.
class MapperHarness {
 public:
  MapperHarness() : handle_("/mapping" + std::to_string(++count())) {
    floor_ = handle_.advertise<FloorGrid>("floor_grid", 10);
    objects_ = handle_.advertise<ObjectList>("objects/merged", 10);
    handle_.setParam("mapper/folder", "/nonexistent");
    handle_.setParam("mapper/map_frame", "hall" + std::to_string(count()));
    cells = std::make_unique<Inbox<MapGrid>>(handle_, "map_cells");
    grids = std::make_unique<Inbox<nav_msgs::OccupancyGrid>>(handle_, "map");
    standing = std::make_unique<Inbox<ObjectList>>(handle_, "static_objects");
    diagnostics_ = handle_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          for (const auto& status : array->status) {
            for (const auto& value : status.values) said_[status.name][value.key] = value.value;
          }
        });
  }
  ~MapperHarness() { handle_.deleteParam(handle_.getNamespace()); }

  ros::NodeHandle& handle() { return handle_; }
  bool load() {
    return loader_.load(handle_.getNamespace() + "/mapper", "pilothouse/Mapper", ros::M_string(),
                        nodelet::V_string());
  }
  FloorGrid grid(double stamp) const {
    FloorGrid grid;
    grid.header.stamp = ros::Time(stamp);
    grid.header.frame_id = "base_link";
    grid.info.resolution = 0.05F;
    grid.info.width = grid.info.height = 40;
    grid.info.origin.position.x = 0.5;
    grid.info.origin.position.y = -1.0;
    grid.info.origin.orientation.w = 1.0;
    grid.classes.assign(1600, FloorGrid::FLOOR);
    grid.heights.assign(1600, kNan);
    grid.deviations = grid.heights;
    return grid;
  }
  void pose(double stamp, double x = 0.0) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time(stamp);
    transform.header.frame_id = "hall" + std::to_string(count());
    transform.child_frame_id = "base_link";
    transform.transform.translation.x = x;
    transform.transform.rotation.w = 1.0;
    transforms_.sendTransform(transform);
  }
  void show(const FloorGrid& grid) { floor_.publish(grid); }
  void show(const ObjectList& list) { objects_.publish(list); }
  std::string said(const std::string& task, const std::string& key) {
    return said_[handle_.getNamespace().substr(1) + "/mapper: " + task][key];
  }
  /// The newest map's class at a place; unknown where there is none.
  MapCell at(double x, double y) const {
    if (cells->all().empty()) return MapCell::kUnknown;
    const auto map = openMap(*cells->all().back());
    return map ? map->at(map->column(x), map->row(y)) : MapCell::kUnknown;
  }
  /// A frame every 50 ms from `stamp` on, until `done`.
  template <class Condition>
  bool run(double stamp, const FloorGrid& like, Condition done, const ObjectList* list = nullptr) {
    return spinUntil([&] {
      FloorGrid now = like;
      now.header.stamp = ros::Time(stamp);
      pose(stamp);
      show(now);
      if (list != nullptr) {
        ObjectList objects = *list;
        objects.header = now.header;
        show(objects);
      }
      stamp += 0.05;
      return done();
    });
  }

  std::unique_ptr<Inbox<MapGrid>> cells;
  std::unique_ptr<Inbox<nav_msgs::OccupancyGrid>> grids;
  std::unique_ptr<Inbox<ObjectList>> standing;

 private:
  static int& count() {
    static int made = 0;
    return made;
  }
  ros::NodeHandle handle_;
  ros::Publisher floor_, objects_;
  ros::Subscriber diagnostics_;
  std::map<std::string, std::map<std::string, std::string>> said_;
  tf2_ros::TransformBroadcaster transforms_;
  nodelet::Loader loader_{false};
};

TEST(Mapper, PublishesWhatItLearnsWhereTfSaysTheRobotIs) {
  MapperHarness harness;
  ASSERT_TRUE(harness.load());
  FloorGrid grid = harness.grid(0.0);
  std::fill(grid.classes.begin(), grid.classes.begin() + 400, FloorGrid::THRESHOLD);
  ASSERT_TRUE(harness.run(1000.0, grid, [&] { return harness.at(1.0, 0.5) == MapCell::kFree; }));
  EXPECT_EQ(harness.at(1.02, -0.77), MapCell::kThreshold);
  EXPECT_EQ(harness.cells->all().back()->header.frame_id.substr(0, 4), "hall");
  ASSERT_FALSE(harness.grids->all().empty());
  const auto& data = harness.grids->all().back()->data;
  EXPECT_EQ(std::count(data.begin(), data.end(), 100), 0);
  EXPECT_GT(std::count(data.begin(), data.end(), 20), 300);
}

TEST(Mapper, ObjectsThatStayEnter) {
  MapperHarness harness;
  ASSERT_TRUE(harness.load());
  FloorGrid grid = harness.grid(0.0);
  grid.classes[20 * 40 + 20] = FloorGrid::OBSTACLE;  // at 1.525, 0.025
  ObjectList list;
  list.objects.resize(1);
  list.objects[0].position.x = 1.525F;
  list.objects[0].position.y = 0.025F;
  list.objects[0].size = 0.05F;
  list.objects[0].kind = Object::OBSTACLE;
  list.source = "camera";
  ASSERT_TRUE(harness.run(
      1000.0, grid, [&] { return harness.at(1.525, 0.025) == MapCell::kOccupied; }, &list));
  ASSERT_TRUE(spinUntil([&] {
    return !harness.standing->all().empty() && !harness.standing->all().back()->objects.empty();
  }));
  EXPECT_NEAR(harness.standing->all().back()->objects[0].position.x, 1.525, 0.026);
  // It leaves: within three frames, of which at least one is under way when it is published.
  FloorGrid without = harness.grid(0.0);
  EXPECT_TRUE(
      harness.run(1060.0, without, [&] { return harness.at(1.525, 0.025) == MapCell::kFree; }));
}

TEST(Mapper, TimeThatRunsBackLeavesTheMapUnharmed) {
  MapperHarness harness;
  ASSERT_TRUE(harness.load());
  const FloorGrid grid = harness.grid(0.0);
  ASSERT_TRUE(harness.run(1000.0, grid, [&] { return harness.at(1.0, 0.5) == MapCell::kFree; }));
  ASSERT_TRUE(harness.run(900.0, grid, [&] {
    return harness.said(harness.handle().resolveName("floor_grid"), "time jumps") == "1" ||
           harness.said("floor_grid", "time jumps") == "1";
  }));
  EXPECT_EQ(harness.at(1.0, 0.5), MapCell::kFree);
}

TEST(Mapper, EndsWhileMessagesCome) {
  for (int round = 0; round < 15; ++round) {
    MapperHarness harness;
    ASSERT_TRUE(harness.load());
    const FloorGrid grid = harness.grid(0.0);
    ASSERT_TRUE(harness.run(1000.0, grid, [&] { return !harness.cells->all().empty(); }));
    // It is taken while the nodelet is unloaded.
    for (int i = 0; i < 8; ++i) harness.show(grid);
  }
}

TEST(Mapper, CountsWhatItRefusesAndWhy) {
  MapperHarness harness;
  ASSERT_TRUE(harness.load());
  const auto refused = [&](const FloorGrid& grid, const std::string& words) {
    return spinUntil([&] {
      harness.show(grid);
      ros::WallDuration(0.05).sleep();
      return harness.said("floor_grid", "last rejection").find(words) != std::string::npos;
    });
  };
  FloorGrid other = harness.grid(1000.0), short_one = other, huge = other;
  other.header.frame_id = "odom";
  EXPECT_TRUE(refused(other, "another frame than base_link"));
  short_one.classes.pop_back();
  EXPECT_TRUE(refused(short_one, "expected 1600"));
  huge.info.resolution = kNan;
  EXPECT_TRUE(refused(huge, "resolution is nan"));
  EXPECT_TRUE(refused(harness.grid(2000.0), "is not known at its stamp"));
  EXPECT_EQ(harness.said("floor_grid", "accepted"), "0");
  EXPECT_EQ(harness.at(1.0, 0.5), MapCell::kUnknown);
}

TEST(Mapper, RefusesToStartWithWrongParameters) {
  MapperHarness harness;
  harness.handle().setParam("mapper/map", "../other");
  EXPECT_FALSE(harness.load());
  harness.handle().deleteParam("mapper/map");
  harness.handle().setParam("mapper/cell_size", -1.0);
  EXPECT_FALSE(harness.load());
  harness.handle().deleteParam("mapper/cell_size");
  harness.handle().setParam("mapper/typo", 1);
  EXPECT_FALSE(harness.load());
}

TEST(VolumeMapper, LearnsPublishesAndRefusesHostileFiles) {
  const OwnFolder folder;
  ros::NodeHandle handle("/volume_mapping");
  handle.setParam("volume_mapper/folder", folder.path);
  handle.setParam("volume_mapper/map_frame", "base_link");
  handle.setParam("volume_mapper/rate", 20.0);
  handle.setParam("volume_mapper/publish_period", 0.2);
  Inbox<sensor_msgs::PointCloud2> points(handle, "volume_points");
  Inbox<visualization_msgs::Marker> cubes(handle, "volume");
  ros::Publisher image = handle.advertise<sensor_msgs::Image>("camera/depth/image_rect", 2);
  ros::Publisher info = handle.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 2);
  const auto camera = broadcastCamera();
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/volume_mapping/volume_mapper", "pilothouse/VolumeMapper",
                          ros::M_string(), nodelet::V_string()));
  const BoxScene scene;
  const auto newest = [&points] { return points.all().empty() ? 0U : points.all().back()->width; };
  ASSERT_TRUE(spinUntil([&] {
    const double now = ros::Time::now().toSec();
    info.publish(scene.info(now));
    image.publish(scene.image(now));
    return newest() > 100 && !cubes.all().empty();
  }));
  EXPECT_EQ(cubes.all().back()->type, visualization_msgs::Marker::CUBE_LIST);
  EXPECT_FALSE(cubes.all().back()->points.empty());

  const auto call = [&](const std::string& service, const std::string& name) {
    MapFile file;
    file.request.name = name;
    EXPECT_TRUE(ros::service::waitForService("/volume_mapping/volume/" + service, 60000));
    EXPECT_TRUE(ros::service::call("/volume_mapping/volume/" + service, file));
    return file.response;
  };
  EXPECT_TRUE(call("save", "hall").success);
  std::ofstream(folder.path + "/bomb.bt") << "# Octomap OcTree binary file\nid OcTree\nsize "
                                             "1000000\nres 0.05\ndata\n"
                                          << std::string(2000000, '\xFF');
  const auto bomb = call("load", "bomb");
  EXPECT_FALSE(bomb.success);
  EXPECT_EQ(bomb.message, folder.path + "/bomb.bt: the tree is deeper than 16 levels");
  EXPECT_FALSE(call("load", "../hall").success);
  EXPECT_TRUE(call("load", "hall").success);
  handle.deleteParam("/volume_mapping");
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_mapper");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle alive;
  return RUN_ALL_TESTS();
}
