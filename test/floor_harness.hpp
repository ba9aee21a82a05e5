#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <nodelet/loader.h>
#include <pilothouse/ObjectList.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pilothouse/FloorGrid.h>
#include "test/box_scene.hpp"

namespace pilothouse {

/// Runs the test's callbacks until `done` or the deadline.
template <class Condition>
bool spinUntil(Condition done, double seconds = 60.0) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(seconds);
  while (!done() && ros::WallTime::now() < deadline) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
  }
  return done();
}

/// A real floor nodelet in a nodelet loader in this process, in a namespace of its own, with a
/// camera before it. The nodelet's callbacks run in the loader's threads, the test's in
/// spinUntil().
class FloorHarness {
 public:
  /// @param type DepthFloor or CloudFloor.
  explicit FloorHarness(std::string type)
      : name_space_("/harness" + std::to_string(++count())), type_(std::move(type)) {
    handle_ = ros::NodeHandle(name_space_);
    image_ = handle_.advertise<sensor_msgs::Image>("camera/depth/image_rect", 10);
    info_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 10);
    cloud_ = handle_.advertise<sensor_msgs::PointCloud2>("camera/depth/points", 10);
    diagnostics_ = handle_.subscribe("/diagnostics", 100, &FloorHarness::takeDiagnostics, this);
  }
  ~FloorHarness() { handle_.deleteParam(name_space_); }

  ros::NodeHandle& handle() { return handle_; }
  std::string name() const { return name_space_ + "/floor"; }
  template <class T>
  void set(const std::string& key, const T& value) {
    handle_.setParam(key, value);
  }
  bool load() {
    return loader_.load(name(), "pilothouse/" + type_, ros::M_string(), nodelet::V_string());
  }
  ros::Publisher& input() { return type_ == "CloudFloor" ? cloud_ : image_; }

  /// One picture of the scene, through the door that the nodelet listens at.
  void show(const BoxScene& scene, double stamp) {
    if (type_ == "CloudFloor") return cloud_.publish(scene.cloud(stamp));
    info_.publish(scene.info(stamp));
    image_.publish(scene.image(stamp));
  }
  template <class M>
  void publish(const boost::shared_ptr<M>& message) {
    publisherOf(message.get()).publish(message);
  }

  bool waitForListener() {
    return spinUntil([this] { return input().getNumSubscribers() > 0; });
  }
  /// A value of the newest diagnostics; empty when there is none (yet). @param task input or
  /// mounting.
  std::string diagnostic(const std::string& task, const std::string& key) {
    return statuses_[name().substr(1) + ": " + task][key];
  }
  bool waitForDiagnostic(const std::string& task, const std::string& key,
                         const std::string& value) {
    return spinUntil([&] { return diagnostic(task, key) == value; });
  }

 private:
  static int& count() {
    static int made = 0;
    return made;
  }
  ros::Publisher& publisherOf(const sensor_msgs::Image*) { return image_; }
  ros::Publisher& publisherOf(const sensor_msgs::CameraInfo*) { return info_; }
  ros::Publisher& publisherOf(const sensor_msgs::PointCloud2*) { return cloud_; }

  void takeDiagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    for (const auto& status : message->status) {
      auto& values = statuses_[status.name];
      values.clear();
      values["message"] = status.message;
      values["level"] = std::to_string(static_cast<int>(status.level));
      for (const auto& value : status.values) values[value.key] = value.value;
    }
  }

  std::string name_space_, type_;
  ros::NodeHandle handle_;
  ros::Publisher image_, info_, cloud_;
  ros::Subscriber diagnostics_;
  std::map<std::string, std::map<std::string, std::string>> statuses_;
  nodelet::Loader loader_{false};
};

/// Everything received on a topic.
template <class M>
class Inbox {
 public:
  Inbox(ros::NodeHandle& handle, const std::string& topic)
      : subscriber_(handle.subscribe<M>(
            topic, 100,
            [this](const boost::shared_ptr<M const>& message) { messages_.push_back(message); })) {}
  const std::vector<boost::shared_ptr<M const>>& all() const { return messages_; }
  bool waitFor(std::size_t count) {
    return spinUntil([&] { return messages_.size() >= count; });
  }
  void shutdown() { subscriber_.shutdown(); }

 private:
  std::vector<boost::shared_ptr<M const>> messages_;
  ros::Subscriber subscriber_;
};

/// Tells tf where BoxScene's camera sits. Keep it alive.
inline std::unique_ptr<tf2_ros::StaticTransformBroadcaster> broadcastCamera() {
  auto broadcaster = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(BoxScene::T_base_optical());
  transform.header.frame_id = "base_link";
  transform.child_frame_id = BoxScene{}.frame;
  broadcaster->sendTransform(transform);
  return broadcaster;
}

}  // namespace pilothouse
