#include "bench/camera_source.hpp"

#include <sensor_msgs/image_encodings.h>

#include <chrono>
#include <cstring>
#include <thread>

namespace pilothouse::bench {

sensor_msgs::Image::Ptr imageOf(const StandardFrame& frame) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.frame_id = kCameraFrame;
  image->width = frame.camera().width;
  image->height = frame.camera().height;
  image->step = image->width * 2;
  image->encoding = sensor_msgs::image_encodings::TYPE_16UC1;
  image->data.resize(frame.depthPixels().size() * 2);
  std::memcpy(image->data.data(), frame.depthPixels().data(), image->data.size());
  return image;
}

sensor_msgs::CameraInfo::Ptr infoOf(const StandardFrame& frame) {
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>();
  const Intrinsics& k = frame.camera().intrinsics;
  info->header.frame_id = kCameraFrame;
  info->width = frame.camera().width;
  info->height = frame.camera().height;
  info->distortion_model = "plumb_bob";
  info->D.assign(5, 0.0);
  info->K = {k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1};
  info->R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info->P = {k.fx, 0, k.cx, 0, 0, k.fy, k.cy, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::PointCloud2::Ptr cloudOf(const StandardFrame& frame) {
  const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header.frame_id = kCameraFrame;
  cloud->width = frame.camera().width;
  cloud->height = frame.camera().height;
  cloud->point_step = 16;
  cloud->row_step = cloud->width * cloud->point_step;
  const char* names[] = {"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    sensor_msgs::PointField field;
    field.name = names[i];
    field.offset = 4 * i;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud->fields.push_back(field);
  }
  cloud->data.resize(frame.cloud16Words().size() * sizeof(float));
  std::memcpy(cloud->data.data(), frame.cloud16Words().data(), cloud->data.size());
  return cloud;
}

CameraSource::CameraSource(ros::NodeHandle handle, bool depth) : depth_(depth) {
  if (depth) {
    publisher_ = handle.advertise<sensor_msgs::Image>("camera/depth/image_rect", 2);
    info_ = handle.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 2);
  } else {
    publisher_ = handle.advertise<sensor_msgs::PointCloud2>("camera/depth/points", 2);
  }
}

void CameraSource::publish() {
  if (!depth_) {
    const auto cloud = cloudOf(frame_);
    cloud->header.stamp = ros::Time::now();
    publisher_.publish(cloud);
    return;
  }
  const auto image = imageOf(frame_);
  const auto info = infoOf(frame_);
  image->header.stamp = info->header.stamp = ros::Time::now();
  info_.publish(info);
  publisher_.publish(image);
}

int CameraSource::publishFor(double seconds) {
  using Clock = std::chrono::steady_clock;
  const int frames = static_cast<int>(seconds * kFrameRate);
  const auto start = Clock::now();
  for (int i = 0; i < frames && ros::ok(); ++i) {
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(i / kFrameRate)));
    publish();
  }
  return frames;
}

}  // namespace pilothouse::bench
