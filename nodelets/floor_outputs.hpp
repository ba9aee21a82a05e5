#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/floor/level_scan.hpp"
#include "core/floor/nearest_objects.hpp"
#include "core/floor/virtual_scan.hpp"

namespace pilothouse {

/// What the floor nodelets publish, each only while somebody listens to it: floor_grid,
/// objects/camera, virtual_scan, level_scan in the base frame; floor_points, obstacle_points in the
/// camera's, as measured (so that who clears along rays knows where they began).
class FloorOutputs {
 public:
  /// Told when the first listener comes (true) and when the last one has left (false).
  using Demand = std::function<void(bool wanted)>;

  /// Advertises; from now on `demand` is called, from the handle's queue.
  void advertise(ros::NodeHandle& handle, Demand demand);
  bool wanted() const;

  /// @param camera header of the picture; @param base_frame of the grid.
  /// @param T_base_camera the mounting that the grid was made with.
  template <class View>
  void publish(const std_msgs::Header& camera, const View& view, const std::string& base_frame,
               const Eigen::Isometry3f& T_base_camera, const FloorCells& grid,
               const FloorParameters& parameters);

 private:
  void notice();

  ros::Publisher grid_, objects_, scan_, level_scan_, floor_points_, obstacle_points_;
  NearestObjects nearest_objects_;
  VirtualScan virtual_scan_;
  LevelScan level_;
  std::vector<CellClass> point_classes_;
  std::mutex demand_mutex_;
  Demand demand_;
  bool demanded_ = false;
};

}  // namespace pilothouse
