#pragma once

#include <utility>
#include <vector>

#include "bench/pose_recording.hpp"

namespace pilothouse::bench {

/// How far a track is from a reference, both at the same times.
struct TrackError {
  double rms = 0.0, max = 0.0;  ///< of places [m]
  double heading_rms = 0.0;     ///< [rad]
};

/// T_reference_track: the rigid motion in the plane that lays the track's places upon the
/// reference's with the least squares (Umeyama, 1991, without scale). As many of both, at least 2.
Pose2 rigidAlignment(const std::vector<StampedPose>& track,
                     const std::vector<StampedPose>& reference);

/// The motion that lays the track's begin upon the reference's: places and headings of the first
/// `count` poses, meant.
Pose2 startAlignment(const std::vector<StampedPose>& track,
                     const std::vector<StampedPose>& reference, std::size_t count);

TrackError errorOf(const std::vector<StampedPose>& track, const std::vector<StampedPose>& reference,
                   const Pose2& T_reference_track);

/// The reference with every stamp later by `offset` [s].
std::vector<StampedPose> later(std::vector<StampedPose> reference, double offset);

/// Which constant, added to the reference's stamps, lays it upon the track best, within +-0.2 s:
/// two clocks are seldom one (Sturm et al., IROS 2012, align in time before in space). [s]
double timeOffset(const std::vector<StampedPose>& track, const std::vector<StampedPose>& reference);

/// The reference's own noise of places [m]: what a smooth track (odometry) leaves of it over a few
/// poses in a row, after a rigid alignment of each such piece. Odometry hardly drifts in that time.
double noiseOf(const std::vector<StampedPose>& smooth, const std::vector<StampedPose>& reference,
               std::size_t piece);

}  // namespace pilothouse::bench
