#include "bench/pose_replay.hpp"

#include <algorithm>
#include <chrono>
#include <deque>

#include "core/pose/pose_algebra.hpp"

namespace pilothouse::bench {
namespace {

class Replayer {
 public:
  Replayer(const PoseRecording& recording, const ReplayParameters& parameters)
      : parameters_(parameters), tracker_(parameters.tracker) {
    for (std::size_t i = 0; i < recording.scan_names.size(); ++i) {
      localisers_.push_back(std::make_unique<ScanLocaliser>(
          parameters.localiser, std::make_unique<IcpMatcher>(parameters.icp)));
    }
  }

  void operator()(const OdometryEvent& event) {
    const auto verdict = tracker_.addOdometry(event.stamp, event.T_odom_base);
    if (verdict != OdometryVerdict::kTaken && verdict != OdometryVerdict::kJumped) return;
    // What the robot learns from here on comes too late for this moment.
    result_.raw.emplace_back(event.stamp, event.T_odom_base);
    result_.corrected.emplace_back(event.stamp, tracker_.newest().pose);
    const auto ended = [this](const ScanEvent& scan) {
      return scan.beams.end() - localisers_[scan.source]->lag().seconds();
    };
    while (!waiting_.empty() && ended(*waiting_.front()) <= event.stamp) {
      localise(*waiting_.front());
      waiting_.pop_front();
    }
  }
  void operator()(const GyroEvent& event) {
    if (parameters_.gyro) tracker_.addGyro(event.stamp, event.rate);
  }
  /// A scan waits until odometry tells where the robot was when it ended.
  void operator()(const ScanEvent& event) { waiting_.push_back(&event); }

  PoseReplay finished() {
    if (scans_ > 0) result_.matching_ms /= static_cast<double>(scans_);
    for (const auto& localiser : localisers_) {
      result_.lags.push_back(localiser->lag().seconds());
      const auto points = localiser->map();
      result_.map.insert(result_.map.end(), points.begin(), points.end());
    }
    return std::move(result_);
  }

 private:
  void localise(const ScanEvent& scan) {
    ScanLocaliser& localiser = *localisers_[scan.source];
    ScanBeams beams = scan.beams;
    beams.stamp -= localiser.lag().seconds();
    const double stamp = beams.end();
    const auto way = tracker_.way(beams.stamp, stamp);
    const auto predicted = tracker_.at(stamp);
    if (!way || !predicted) {
      ++result_.verdicts[nameOf(MatchVerdict::kNoTrack)];
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto points = pointsOf(beams, scan.mounting, TrackPiece(*way), stamp);
    const ScanMatch match =
        localiser.match(points, *predicted, scan.mounting.T_base_sensor.position());
    const MatchVerdict verdict = tracker_.correct(stamp, match);
    localiser.learn(verdict, tracker_.at(stamp)->pose);
    const auto lately = tracker_.way(stamp - ScanLag::kWay, stamp);
    if (verdict == MatchVerdict::kAccepted && lately) {
      localiser.lag().learn(stamp, match, *lately);
    }
    result_.matching_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    ++scans_;
    ++result_.verdicts[nameOf(verdict)];
  }

  ReplayParameters parameters_;
  PoseTracker tracker_;
  std::vector<std::unique_ptr<ScanLocaliser>> localisers_;
  std::deque<const ScanEvent*> waiting_;
  PoseReplay result_;
  std::size_t scans_ = 0;
};

}  // namespace

PoseReplay replay(const PoseRecording& recording, const ReplayParameters& parameters) {
  Replayer replayer(recording, parameters);
  for (const auto& event : recording.events) std::visit(replayer, event);
  return replayer.finished();
}

void pairUp(const std::vector<StampedPose>& track, const std::vector<StampedPose>& reference,
            std::vector<StampedPose>& track_there, std::vector<StampedPose>& reference_there) {
  if (track.empty()) return;
  const TrackPiece way(track);
  for (const StampedPose& truth : reference) {
    if (truth.first < track.front().first || truth.first > track.back().first) continue;
    track_there.emplace_back(truth.first, way.at(truth.first));
    reference_there.push_back(truth);
  }
}

}  // namespace pilothouse::bench
