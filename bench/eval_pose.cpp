/// Corrects odometry by scans, and judges the corrected track beside the raw one by the truth.
/// docs/pose.md says what is counted.

#include <cmath>
#include <cstdio>
#include <iostream>

#include "bench/eval_options.hpp"
#include "bench/floor_bars.hpp"
#include "bench/json_line.hpp"
#include "bench/pose_bag.hpp"
#include "bench/pose_replay.hpp"
#include "bench/track_error.hpp"

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{
    "eval pose",
    "Tracks a robot's pose by odometry corrected by scans, and compares the corrected track and "
    "the raw\none with a reference. With --bag: of a recording with LaserScan, odometry (tf or "
    "nav_msgs/Odometry)\nand, to be judged, a topic with ground_truth in its name; without: of "
    "simulated robots in random worlds.",
    {"--bag", "--runs", "--seed", "--out"}};

constexpr std::size_t kStart = 4;  // poses that lay the tracks' begins upon each other
constexpr std::size_t kPiece = 5;  // poses in a row, to tell the reference's own noise

struct Judged {
  TrackError raw, corrected;              // after the best rigid alignment of each
  TrackError raw_start, corrected_start;  // after laying their begins upon each other
  double noise = 0.0;
};

Judged judge(const PoseRecording& recording, const PoseReplay& tracks) {
  std::vector<StampedPose> raw, corrected, truth, again;
  pairUp(tracks.raw, recording.reference, raw, truth);
  pairUp(tracks.corrected, recording.reference, corrected, again);
  Judged judged;
  judged.raw = errorOf(raw, truth, rigidAlignment(raw, truth));
  judged.corrected = errorOf(corrected, truth, rigidAlignment(corrected, truth));
  judged.raw_start = errorOf(raw, truth, startAlignment(raw, truth, kStart));
  judged.corrected_start = errorOf(corrected, truth, startAlignment(corrected, truth, kStart));
  judged.noise = noiseOf(raw, truth, kPiece);
  return judged;
}

int evaluateBag(const EvalOptions& options) {
  const auto recording = readPoseBag(options.bag);
  if (!recording) refuse(kCommand, recording.reason());
  const PoseReplay tracks = replay(*recording, {});
  for (const auto& note : recording->notes) std::cerr << note << "\n";
  JsonLine verdicts;
  for (const auto& [name, count] : tracks.verdicts) verdicts.whole(name, count);
  const Judged judged = judge(*recording, tracks);
  JsonLine line;
  line.number("raw_rms_m", judged.raw.rms, 4).number("corrected_rms_m", judged.corrected.rms, 4);
  line.number("raw_max_m", judged.raw.max, 4).number("corrected_max_m", judged.corrected.max, 4);
  line.number("raw_heading_rms_rad", judged.raw.heading_rms, 4)
      .number("corrected_heading_rms_rad", judged.corrected.heading_rms, 4);
  line.number("raw_start_rms_m", judged.raw_start.rms, 4)
      .number("corrected_start_rms_m", judged.corrected_start.rms, 4);
  line.number("noise", judged.noise, 4)
      .object("matches", verdicts)
      .number("matching_ms", tracks.matching_ms, 2);
  line.whole("reference_poses", recording->reference.size()).text("odometry", recording->odometry);
  std::cout << line.str() << std::endl;
  return 0;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  const EvalOptions options = readOptions(kCommand, argc, argv);
  try {
    return evaluateBag(options);
  } catch (const std::exception& fault) {
    refuse(kCommand, fault.what());
  }
}
