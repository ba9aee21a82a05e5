#include "bench/pose_judging.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::bench {
namespace {

constexpr std::size_t kStart = 4;  // poses that lay the tracks' begins upon each other
constexpr std::size_t kPiece = 5;  // poses in a row that tell the reference's own noise

/// Both tracks at the reference's times.
struct Paired {
  std::vector<StampedPose> raw, corrected, truth;
  Paired(const PoseReplay& tracks, const std::vector<StampedPose>& reference) {
    std::vector<StampedPose> truth_again;
    pairUp(tracks.raw, reference, raw, truth);
    pairUp(tracks.corrected, reference, corrected, truth_again);
  }
};

TrackError fitted(const std::vector<StampedPose>& track, const std::vector<StampedPose>& truth) {
  return errorOf(track, truth, rigidAlignment(track, truth));
}

TrackError begun(const std::vector<StampedPose>& track, const std::vector<StampedPose>& truth) {
  return errorOf(track, truth, startAlignment(track, truth, kStart));
}

}  // namespace

PoseJudgement judge(const PoseRecording& recording, const PoseReplay& tracks, bool one_clock) {
  PoseJudgement judgement;
  const Paired as_they_came(tracks, recording.reference);
  if (as_they_came.truth.size() < 10) return judgement;
  judgement.judged = true;
  judgement.raw_unshifted = fitted(as_they_came.raw, as_they_came.truth);
  judgement.corrected_unshifted = fitted(as_they_came.corrected, as_they_came.truth);
  if (!one_clock) judgement.offset = timeOffset(tracks.raw, recording.reference);
  const Paired paired(tracks, later(recording.reference, judgement.offset));
  const auto& [raw, corrected, truth] = paired;
  judgement.poses = truth.size();
  judgement.raw_fit = fitted(raw, truth);
  judgement.corrected_fit = fitted(corrected, truth);
  judgement.raw_begin = begun(raw, truth);
  judgement.corrected_begin = begun(corrected, truth);
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

double shareWithoutNoise(const PoseJudgement& judgement) {
  const double noise = judgement.noise * judgement.noise;
  const double raw = judgement.raw_fit.rms * judgement.raw_fit.rms - noise;
  const double corrected = judgement.corrected_fit.rms * judgement.corrected_fit.rms - noise;
  return raw > 0.0 ? std::sqrt(std::max(0.0, corrected) / raw) : std::nan("");
}

void describe(const PoseJudgement& judgement, const PoseReplay& tracks, JsonLine& line) {
  JsonLine matches;
  for (const auto& [name, count] : tracks.verdicts) matches.whole(name, count);
  line.object("matches", matches).number("matching_ms", tracks.matching_ms, 2);
  for (std::size_t i = 0; i < tracks.lags.size(); ++i) {
    line.number("scanner_" + std::to_string(i) + "_late_s", tracks.lags[i], 3);
  }
  if (!judgement.judged) return;
  const auto add = [&line](const std::string& name, const TrackError& error) {
    line.number(name + "_rms_m", error.rms, 4).number(name + "_max_m", error.max, 4);
    line.number(name + "_heading_rms_rad", error.heading_rms, 4);
  };
  add("raw_fit", judgement.raw_fit);
  add("corrected_fit", judgement.corrected_fit);
  add("raw_unshifted", judgement.raw_unshifted);
  add("corrected_unshifted", judgement.corrected_unshifted);
  add("raw_begin", judgement.raw_begin);
  add("corrected_begin", judgement.corrected_begin);
  line.number("reference_late_s", -judgement.offset, 3);
  line.whole("reference_poses", judgement.poses).number("reference_noise_m", judgement.noise, 4);
  line.number("reference_longest_gap_s", judgement.longest_gap, 3);
  line.number("reference_fastest_mps", judgement.fastest, 2)
      .number("driven_m", judgement.driven, 2);
}

}  // namespace pilothouse::bench
