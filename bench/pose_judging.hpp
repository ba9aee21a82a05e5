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
  /// With the begins laid upon each other, as a robot knows where it starts and must keep it.
  TrackError raw, corrected;
  /// After the best rigid alignment of each whole track: the form of the error alone.
  TrackError raw_fit, corrected_fit;
  double noise = 0.0;        ///< the reference's own, of places [m]
  double longest_gap = 0.0;  ///< between reference poses [s]
  double fastest = 0.0;      ///< between reference poses [m/s]: a jump shows
  double driven = 0.0;       ///< way of the reference [m]
};

PoseJudgement judge(const PoseRecording& recording, const PoseReplay& tracks);

/// All figures, one JSON object.
void describe(const PoseJudgement& judgement, const PoseReplay& tracks, JsonLine& line);

}  // namespace pilothouse::bench
