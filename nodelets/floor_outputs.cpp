#include "nodelets/floor_outputs.hpp"

#include "nodelets/floor_messages.hpp"

namespace pilothouse {

void FloorOutputs::advertise(ros::NodeHandle& handle, Demand demand) {
  // Held to the end: a listener may connect before the last publisher exists.
  std::lock_guard<std::mutex> lock(demand_mutex_);
  demand_ = std::move(demand);
  const auto notice = [this](const ros::SingleSubscriberPublisher&) { this->notice(); };
  grid_ = handle.advertise<FloorGridMessage>("floor_grid", 2, notice, notice);
  objects_ = handle.advertise<ObjectList>("objects/camera", 2, notice, notice);
  scan_ = handle.advertise<sensor_msgs::LaserScan>("virtual_scan", 2, notice, notice);
}

bool FloorOutputs::wanted() const {
  for (const ros::Publisher* publisher : {&grid_, &objects_, &scan_}) {
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

void FloorOutputs::publish(const std_msgs::Header& base, const FloorGrid& grid,
                           FloorMethod method) {
  if (grid_.getNumSubscribers() > 0) grid_.publish(toMessage(base, grid, method));
  if (objects_.getNumSubscribers() > 0) {
    objects_.publish(toMessage(base, grid, nearest_objects_.find(grid)));
  }
  if (scan_.getNumSubscribers() > 0) {
    const auto& ranges = virtual_scan_.scan(grid);
    scan_.publish(toMessage(base, virtual_scan_.geometry(), ranges));
  }
}

}  // namespace pilothouse
