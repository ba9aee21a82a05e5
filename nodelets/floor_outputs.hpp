#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <functional>
#include <mutex>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_grid.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/floor/nearest_objects.hpp"
#include "core/floor/virtual_scan.hpp"

namespace pilothouse {

/// What the floor nodelets publish, each only while somebody listens to it: floor_grid,
/// objects/camera, virtual_scan.
class FloorOutputs {
 public:
  /// Told when the first listener comes (true) and when the last one has left (false).
  using Demand = std::function<void(bool wanted)>;

  /// Advertises; from now on `demand` is called, from the handle's queue.
  void advertise(ros::NodeHandle& handle, Demand demand);
  bool wanted() const;

  /// @param base frame: the robot's base; stamp: the camera's.
  void publish(const std_msgs::Header& base, const FloorGrid& grid, FloorMethod method);

 private:
  void notice();

  ros::Publisher grid_, objects_, scan_;
  NearestObjects nearest_objects_;
  VirtualScan virtual_scan_;
  std::mutex demand_mutex_;
  Demand demand_;
  bool demanded_ = false;
};

}  // namespace pilothouse
