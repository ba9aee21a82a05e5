#pragma once

#include <ros/node_handle.h>

#include <string>

#include "nodelets/map_keeper.hpp"

namespace pilothouse {

/// The mapper's parameters.
struct MapperSettings {
  std::string base_frame = "base_link", map_frame = "map";
  bool use_scan = false;      ///< learns from the topic scan too
  double publish_rate = 2.0;  ///< of what has changed [Hz], 0.1..30
  double autosave = 10.0;  ///< the map of the name is saved so often where it changed [s], 1..3600
  MapKeeperSettings keeper;
};

/// @throws ParameterFault naming each fault.
MapperSettings readMapperSettings(const ros::NodeHandle& own);

}  // namespace pilothouse
