#pragma once

#include <string>

#include "bench/json_line.hpp"
#include "bench/pose_recording.hpp"
#include "bench/pose_replay.hpp"
#include "bench/track_error.hpp"

namespace pilothouse::bench {

/// The raw and the corrected track beside the reference.
struct PoseJudgement {
  bool judged = false;  ///< there is a reference, and it is where the track is
  std::size_t poses = 0;
  /// Added to the reference's stamps before all else, for both tracks alike; found for the raw one,
  /// and only where the clocks are not known to be one [s].
  double offset = 0.0;
  /// After the best rigid alignment of each whole track.
  TrackError raw_fit, corrected_fit;
  /// The same with the reference's stamps as they came.
  TrackError raw_unshifted, corrected_unshifted;
  /// With the begins laid upon each other, as a robot knows where it starts and must keep it.
  TrackError raw_begin, corrected_begin;
  double noise = 0.0;        ///< the reference's own, of places [m]
  double longest_gap = 0.0;  ///< between reference poses [s]
  double fastest = 0.0;      ///< between reference poses [m/s]: a jump shows
  double driven = 0.0;       ///< way of the reference [m]
};

/// @param one_clock the reference's stamps are of odometry's clock and exact.
PoseJudgement judge(const PoseRecording& recording, const PoseReplay& tracks, bool one_clock);

/// The corrected track's share of the raw one's error, after the reference's own noise was taken
/// off both in quadrature. NaN where the raw one is no greater than that.
double shareWithoutNoise(const PoseJudgement& judgement);

/// All figures, one JSON object.
void describe(const PoseJudgement& judgement, const PoseReplay& tracks, JsonLine& line);

}  // namespace pilothouse::bench
