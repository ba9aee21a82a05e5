#pragma once

#include <ros/node_handle.h>

#include <string>

#include "nodelets/map_keeper.hpp"
#include "nodelets/service_thread.hpp"

namespace pilothouse {

/// map/save, map/load (MapFile), map/clear (Trigger) and map_server's static_map.
class MapServices {
 public:
  /// @param handle names are resolved by it. @param keeper must outlive this.
  MapServices(const ros::NodeHandle& handle, MapKeeper& keeper, const std::string& map_frame);

 private:
  ServiceThread services_;
};

}  // namespace pilothouse
