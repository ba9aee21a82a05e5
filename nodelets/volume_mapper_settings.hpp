#pragma once

#include <ros/node_handle.h>

#include <string>

#include "nodelets/volume_keeper.hpp"

namespace pilothouse {

/// The volume mapper's parameters.
struct VolumeMapperSettings {
  std::string map_frame = "map";
  double rate = 3.0;            ///< pictures that are taken [Hz], 0.1..30
  double publish_period = 1.0;  ///< [s], 0.2..60
  double autosave =
      10.0;  ///< the octree of the name is saved so often where it changed [s], 1..3600
  int most_shown = 100000;  ///< voxels that are published, 1..1000000
  VolumeKeeperSettings keeper;
};

/// @throws ParameterFault naming each fault.
VolumeMapperSettings readVolumeMapperSettings(const ros::NodeHandle& own);

}  // namespace pilothouse
