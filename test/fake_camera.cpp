// Publishes what a robot with a depth camera would: for the console's test as a whole.
// fake_camera [--lying-depth]: with it the depth images claim more rows than they carry.

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <cstring>
#include <string>

#include <pilothouse/FloorGrid.h>
#include "pilothouse/ObjectList.h"

namespace {

sensor_msgs::Image depthImage() {
  sensor_msgs::Image image;
  image.header.frame_id = "camera_depth_optical_frame";
  image.width = 64;
  image.height = 48;
  image.step = 128;
  image.encoding = "16UC1";
  image.data.resize(std::size_t{128} * 48);
  for (std::size_t i = 0; i < std::size_t{64} * 48; ++i) {
    const auto millimetres = static_cast<std::uint16_t>(1000 + i % 64 * 10);
    std::memcpy(&image.data[i * 2], &millimetres, 2);
  }
  return image;
}

pilothouse::FloorGrid floorGrid() {
  pilothouse::FloorGrid grid;
  grid.header.frame_id = "base_link";
  grid.info.width = 40;
  grid.info.height = 40;
  grid.info.resolution = 0.1F;
  grid.info.origin.position.x = 0.2;
  grid.info.origin.position.y = -2.0;
  grid.info.origin.orientation.w = 1.0;
  grid.classes.assign(1600, pilothouse::FloorGrid::FLOOR);
  grid.heights.assign(1600, 0.0F);
  grid.deviations.assign(1600, 0.002F);
  grid.method = "improved";
  return grid;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "fake_camera");
  ros::NodeHandle nh;
  const bool lying = argc > 1 && std::string(argv[1]) == "--lying-depth";
  auto depth_pub = nh.advertise<sensor_msgs::Image>("camera/depth/image_rect", 1);
  auto info_pub = nh.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 1);
  auto colour_pub = nh.advertise<sensor_msgs::Image>("camera/rgb/image_rect_color", 1);
  auto floor_pub = nh.advertise<pilothouse::FloorGrid>("floor_grid", 1);
  auto objects_pub = nh.advertise<pilothouse::ObjectList>("objects/camera", 1);
  auto depth = depthImage();
  sensor_msgs::CameraInfo info;
  info.width = depth.width;
  info.height = depth.height;
  info.K = {60, 0, 32, 0, 60, 24, 0, 0, 1};
  info.P = {60, 0, 32, 0, 0, 60, 24, 0, 0, 0, 1, 0};
  if (lying) depth.height = 4800;
  sensor_msgs::Image colour;
  colour.width = 64;
  colour.height = 48;
  colour.step = 192;
  colour.encoding = "rgb8";
  colour.data.assign(std::size_t{192} * 48, 100);
  auto floor = floorGrid();
  pilothouse::ObjectList objects;
  ros::WallRate rate(20);
  while (ros::ok()) {
    const ros::Time now = ros::Time::now();
    depth.header.stamp = info.header.stamp = colour.header.stamp = now;
    floor.header.stamp = objects.header.stamp = now;
    info_pub.publish(info);
    depth_pub.publish(depth);
    colour_pub.publish(colour);
    floor_pub.publish(floor);
    objects_pub.publish(objects);
    ros::spinOnce();
    rate.sleep();
  }
}
