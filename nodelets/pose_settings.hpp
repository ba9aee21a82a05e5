#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "core/pose/scan_localiser.hpp"
#include "core/pose/tracker_parameters.hpp"
#include "registration/icp_matcher.hpp"

namespace pilothouse {

/// What the pose tracker is told.
struct PoseSettings {
  std::string base_frame = "base_link", odom_frame = "odom", map_frame = "map";
  std::vector<std::string> scans{"level_scan"};  ///< topics
  bool given_map = false;       ///< match: map (a given one, topic map) or scans (what they met)
  bool stamped_at_end = false;  ///< scan_stamp: end or begin, of the scanners
  TrackerParameters tracker;
  LocaliserParameters localiser;
  IcpParameters icp;
};

/// @throws ParameterFault with every fault.
PoseSettings readPoseSettings(const ros::NodeHandle& handle);

}  // namespace pilothouse
