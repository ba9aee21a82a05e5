// The space that was learnt, as the 3D view draws it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "doors/message_views.hpp"
#include "gui/model/volume_boxes.hpp"

namespace pilothouse::gui {
namespace {

sensor_msgs::PointCloud2 cloudOf(const std::vector<Eigen::Vector3f>& points) {
  sensor_msgs::PointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.height = 1;
  for (const char* name : {"x", "y", "z"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += 4;
  }
  cloud.row_step = cloud.width * cloud.point_step;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(points.data());
  cloud.data.assign(bytes, bytes + 12 * points.size());
  return cloud;
}

/// A wall of 5 cm voxels on both sides of the origin: x at -0.025, y from -2 to 2, z from 0 to 1.
std::vector<Eigen::Vector3f> wall() {
  std::vector<Eigen::Vector3f> points;
  for (int y = -40; y < 40; ++y) {
    for (int z = 0; z < 20; ++z) {
      points.emplace_back(-0.025F, (static_cast<float>(y) + 0.5F) * 0.05F,
                          (static_cast<float>(z) + 0.5F) * 0.05F);
    }
  }
  return points;
}

TEST(VolumeBoxes, AreTheVoxelsWhereTheyAreFew) {
  const auto points = wall();
  const auto cloud = cloudOf(points);
  const VolumeBoxes boxes = boxesOf(*openView(cloud), 0.05F, 10000);
  EXPECT_EQ(boxes.edge, 0.05F);
  ASSERT_EQ(boxes.middles.size(), points.size());
  for (const auto& point : points) {
    double nearest = 1.0;
    for (const auto& box : boxes.middles) {
      nearest = std::min(nearest, static_cast<double>((box - point).norm()));
    }
    EXPECT_LT(nearest, 1e-4) << point.transpose();
  }
}

TEST(VolumeBoxes, GrowWhereTheyAreManyAndLeaveNoHole) {
  const auto points = wall();
  const auto cloud = cloudOf(points);
  const VolumeBoxes boxes = boxesOf(*openView(cloud), 0.05F, 500);
  EXPECT_EQ(boxes.edge, 0.1F);
  EXPECT_EQ(boxes.middles.size(), 400U) << "40 x 10 cubes of 10 cm";
  for (const auto& point : points) {
    bool held = false;
    for (const auto& box : boxes.middles) {
      held = held || (box - point).cwiseAbs().maxCoeff() < 0.05F + 1e-4F;
    }
    EXPECT_TRUE(held) << point.transpose();
  }
}

TEST(VolumeBoxes, LeaveOutWhatIsNoPlace) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto cloud = cloudOf({{nan, 0.0F, 0.0F},
                              {0.0F, std::numeric_limits<float>::infinity(), 0.0F},
                              {0.0F, 0.0F, -1e30F},
                              {1.0F, 1.0F, nan},
                              {1.01F, 1.01F, 0.01F},
                              {1.02F, 1.02F, 0.02F}});
  const VolumeBoxes boxes = boxesOf(*openView(cloud), 0.05F, 100);
  ASSERT_EQ(boxes.middles.size(), 1U) << "two points of one voxel";
  EXPECT_TRUE(boxes.middles[0].isApprox(Eigen::Vector3f(1.025F, 1.025F, 0.025F), 1e-4F));
  EXPECT_TRUE(boxesOf(*openView(cloudOf({})), 0.05F, 100).middles.empty());
  EXPECT_GT(boxesOf(*openView(cloud), 0.0F, 100).edge, 0.0F);
}

TEST(VolumeBoxes, AreBrighterTheHigherTheyAre) {
  const DepthRamp ramp;
  int before = -1;
  for (float height = 0.0F; height <= 1.2F; height += 0.1F) {
    const int brightness = qGray(colourOfHeight(ramp, height));
    EXPECT_GT(brightness, before) << height;
    before = brightness;
  }
  EXPECT_EQ(colourOfHeight(ramp, -0.3F), colourOfHeight(ramp, 0.0F));
  EXPECT_EQ(colourOfHeight(ramp, 9.0F), colourOfHeight(ramp, 1.2F));
}

}  // namespace
}  // namespace pilothouse::gui
