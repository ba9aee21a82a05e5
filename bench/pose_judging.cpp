#include "bench/pose_judging.hpp"

#include <algorithm>

namespace pilothouse::bench {
namespace {

constexpr std::size_t kStart = 4;  // poses that lay the tracks' begins upon each other
constexpr std::size_t kPiece = 5;  // poses in a row that tell the reference's own noise

}  // namespace

PoseJudgement judge(const PoseRecording& recording, const PoseReplay& tracks) {
  std::vector<StampedPose> raw, corrected, truth, truth_again;
  pairUp(tracks.raw, recording.reference, raw, truth);
  pairUp(tracks.corrected, recording.reference, corrected, truth_again);
  PoseJudgement judgement;
  judgement.poses = truth.size();
  if (truth.size() < 10) return judgement;
  judgement.judged = true;
  judgement.raw = errorOf(raw, truth, startAlignment(raw, truth, kStart));
  judgement.corrected = errorOf(corrected, truth, startAlignment(corrected, truth, kStart));
  judgement.raw_fit = errorOf(raw, truth, rigidAlignment(raw, truth));
  judgement.corrected_fit = errorOf(corrected, truth, rigidAlignment(corrected, truth));
  judgement.noise = noiseOf(raw, truth, kPiece);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const double gap = truth[i].first - truth[i - 1].first;
    const double way = (truth[i].second.position() - truth[i - 1].second.position()).norm();
    judgement.longest_gap = std::max(judgement.longest_gap, gap);
    if (gap > 0.0) judgement.fastest = std::max(judgement.fastest, way / gap);
    judgement.driven += way;
  }
  return judgement;
}

void describe(const PoseJudgement& judgement, const PoseReplay& tracks, JsonLine& line) {
  JsonLine matches;
  for (const auto& [name, count] : tracks.verdicts) matches.whole(name, count);
  line.object("matches", matches).number("matching_ms", tracks.matching_ms, 2);
  if (!judgement.judged) return;
  const auto add = [&line](const std::string& name, const TrackError& error) {
    line.number(name + "_rms_m", error.rms, 4).number(name + "_max_m", error.max, 4);
    line.number(name + "_heading_rms_rad", error.heading_rms, 4);
  };
  add("raw", judgement.raw);
  add("corrected", judgement.corrected);
  add("raw_fit", judgement.raw_fit);
  add("corrected_fit", judgement.corrected_fit);
  line.whole("reference_poses", judgement.poses).number("reference_noise_m", judgement.noise, 4);
  line.number("reference_longest_gap_s", judgement.longest_gap, 3);
  line.number("reference_fastest_mps", judgement.fastest, 2)
      .number("driven_m", judgement.driven, 2);
}

}  // namespace pilothouse::bench
