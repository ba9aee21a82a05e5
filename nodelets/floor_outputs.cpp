#include "nodelets/floor_outputs.hpp"

#include "core/floor/point_gather.hpp"
#include "core/floor/point_split.hpp"
#include "nodelets/floor_messages.hpp"

namespace pilothouse {

void FloorOutputs::advertise(ros::NodeHandle& handle, Demand demand) {
  // Held to the end: a listener may connect before the last publisher exists.
  std::lock_guard<std::mutex> lock(demand_mutex_);
  demand_ = std::move(demand);
  const auto notice = [this](const ros::SingleSubscriberPublisher&) { this->notice(); };
  grid_ = handle.advertise<FloorGrid>("floor_grid", 2, notice, notice);
  objects_ = handle.advertise<ObjectList>("objects/camera", 2, notice, notice);
  scan_ = handle.advertise<sensor_msgs::LaserScan>("virtual_scan", 2, notice, notice);
  level_scan_ = handle.advertise<sensor_msgs::LaserScan>("level_scan", 2, notice, notice);
  floor_points_ = handle.advertise<sensor_msgs::PointCloud2>("floor_points", 2, notice, notice);
  obstacle_points_ =
      handle.advertise<sensor_msgs::PointCloud2>("obstacle_points", 2, notice, notice);
}

bool FloorOutputs::wanted() const {
  for (const ros::Publisher* publisher :
       {&grid_, &objects_, &scan_, &level_scan_, &floor_points_, &obstacle_points_}) {
    if (*publisher && publisher->getNumSubscribers() > 0) return true;
  }
  return false;
}

void FloorOutputs::notice() {
  std::lock_guard<std::mutex> lock(demand_mutex_);
  const bool now = wanted();
  if (now == demanded_) return;
  demanded_ = now;
  demand_(now);
}

template <class View>
void FloorOutputs::publish(const std_msgs::Header& camera, const View& view,
                           const std::string& base_frame, const Eigen::Isometry3f& T_base_camera,
                           const FloorCells& grid, const FloorParameters& parameters) {
  std_msgs::Header base = camera;
  base.frame_id = base_frame;
  if (grid_.getNumSubscribers() > 0) grid_.publish(toMessage(base, grid, parameters.method));
  if (objects_.getNumSubscribers() > 0) {
    objects_.publish(toMessage(base, grid, nearest_objects_.find(grid)));
  }
  if (scan_.getNumSubscribers() > 0) {
    const auto& ranges = virtual_scan_.scan(grid);
    scan_.publish(toMessage(base, virtual_scan_.geometry(), ranges));
  }
  if (level_scan_.getNumSubscribers() > 0) {
    const auto& ranges = level_.scan(view, T_base_camera);
    level_scan_.publish(toMessage(base, level_.geometry(), ranges));
  }
  const bool want_floor = floor_points_.getNumSubscribers() > 0;
  const bool want_obstacles = obstacle_points_.getNumSubscribers() > 0;
  if (!want_floor && !want_obstacles) return;
  splitPoints(view, T_base_camera, grid, parameters, point_classes_);
  const auto publishKind = [&](const ros::Publisher& publisher, PointKind kind) {
    std::vector<std::uint8_t> xyz;
    gatherPoints(view, point_classes_, kind, xyz);
    publisher.publish(toMessage(camera, std::move(xyz)));
  };
  if (want_floor) publishKind(floor_points_, PointKind::kFloor);
  if (want_obstacles) publishKind(obstacle_points_, PointKind::kObstacle);
}

template void FloorOutputs::publish(const std_msgs::Header&, const CloudView&, const std::string&,
                                    const Eigen::Isometry3f&, const FloorCells&,
                                    const FloorParameters&);
template void FloorOutputs::publish(const std_msgs::Header&, const DepthView&, const std::string&,
                                    const Eigen::Isometry3f&, const FloorCells&,
                                    const FloorParameters&);

}  // namespace pilothouse
