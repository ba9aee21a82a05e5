#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "nodelets/map_keeper.hpp"

namespace pilothouse {

/// map/save, map/load (MapFile), map/clear (Trigger) and map_server's static_map.
class MapServices {
 public:
  /// @param handle whose callbacks may take their time: a disk is waited for.
  /// @param keeper must outlive this.
  MapServices(ros::NodeHandle& handle, MapKeeper& keeper, const std::string& map_frame);

 private:
  std::vector<ros::ServiceServer> services_;
};

}  // namespace pilothouse
