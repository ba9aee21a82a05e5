#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/pose_recording.hpp"
#include "core/pose/pose_tracker.hpp"
#include "core/pose/scan_localiser.hpp"
#include "registration/icp_matcher.hpp"

namespace pilothouse::bench {

struct ReplayParameters {
  TrackerParameters tracker;
  LocaliserParameters localiser;
  IcpParameters icp;
  bool gyro = true;
};

/// What the tracker made of a recording: its poses as it told them live, none of them with the
/// knowledge of a later scan.
struct PoseReplay {
  std::vector<StampedPose> raw, corrected;      ///< at each odometry
  std::map<std::string, std::size_t> verdicts;  ///< matches by what became of them
  std::vector<MapPoint> map;                    ///< what the scans met, all scanners
  std::vector<double> lags;                     ///< learnt of each scanner [s]
  double matching_ms = 0.0;                     ///< a scan, mean
};

PoseReplay replay(const PoseRecording& recording, const ReplayParameters& parameters);

/// The track at the reference's times, both cut to where they overlap.
void pairUp(const std::vector<StampedPose>& track, const std::vector<StampedPose>& reference,
            std::vector<StampedPose>& track_there, std::vector<StampedPose>& reference_there);

}  // namespace pilothouse::bench
