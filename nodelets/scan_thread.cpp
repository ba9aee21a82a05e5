#include "nodelets/scan_thread.hpp"

#include <algorithm>
#include <utility>

namespace pilothouse {
namespace {

constexpr double kPatience = 0.5;         // for odometry [s]
constexpr std::size_t kMostWaiting = 32;  // scans of one scanner

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

ScanThread::ScanThread(SharedTracker& shared,
                       std::vector<std::unique_ptr<ScanLocaliser>> localisers)
    : shared_(shared), localisers_(std::move(localisers)), waiting_(localisers_.size()) {
  report_.lags.resize(localisers_.size());
  thread_ = std::thread([this] { run(); });
}

ScanThread::~ScanThread() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ScanThread::take(std::size_t source, ScanBeams beams, const ScanMounting& mounting) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    auto& waiting = waiting_[source];
    waiting.push_back({std::move(beams), mounting, Clock::now()});
    if (waiting.size() > kMostWaiting) {
      waiting.pop_front();
      ++report_.overtaken;
    }
    woken_ = true;
  }
  changed_.notify_all();
}

void ScanThread::give(MapCells map) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    given_ = std::move(map);
    woken_ = true;
  }
  changed_.notify_all();
}

void ScanThread::wake() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

ScanThread::Report ScanThread::report() {
  std::lock_guard<std::mutex> lock(mutex_);
  Report report = report_;
  if (accepted_) report.accepted_ago = seconds(Clock::now() - *accepted_);
  return report;
}

std::optional<ScanThread::Waiting> ScanThread::next(std::size_t& source) {
  double newest = 0.0;
  {
    std::lock_guard<std::mutex> lock(shared_.mutex);
    if (shared_.tracker.known()) newest = shared_.tracker.newest().stamp;
  }
  std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    auto& waiting = waiting_[i];
    const auto ready = std::find_if(waiting.rbegin(), waiting.rend(), [&](const Waiting& scan) {
      const bool stale = seconds(Clock::now() - scan.arrived) > kPatience;
      return stale || scan.beams.end() - localisers_[i]->lag().seconds() <= newest;
    });
    if (ready == waiting.rend()) continue;
    source = i;
    Waiting scan = std::move(*ready);
    const auto taken = waiting.rend() - ready;
    report_.overtaken += static_cast<std::uint64_t>(taken - 1);
    waiting.erase(waiting.begin(), waiting.begin() + taken);
    return scan;
  }
  return std::nullopt;
}

void ScanThread::run() {
  for (;;) {
    std::optional<MapCells> given;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return ended_ || woken_; });
      if (ended_) return;
      woken_ = false;
      given = std::exchange(given_, std::nullopt);
    }
    if (given) {
      const auto edges = edgesOf(*given);
      for (const auto& localiser : localisers_) localiser->give(edges);
    }
    std::size_t source = 0;
    while (auto scan = next(source)) {
      localise(source, *scan);
      std::lock_guard<std::mutex> lock(mutex_);
      if (ended_) return;
    }
  }
}

void ScanThread::localise(std::size_t source, Waiting& scan) {
  const auto begin = Clock::now();
  ScanLocaliser& localiser = *localisers_[source];
  scan.beams.stamp -= localiser.lag().seconds();
  const double stamp = scan.beams.end();
  std::optional<std::vector<std::pair<double, Pose2>>> way;
  std::optional<PoseEstimate> predicted;
  std::uint64_t epoch = 0;
  {
    std::lock_guard<std::mutex> lock(shared_.mutex);
    way = shared_.tracker.way(scan.beams.stamp, stamp);
    predicted = shared_.tracker.at(stamp);
    epoch = shared_.tracker.epoch();
  }
  if (!way || !predicted) return count(MatchVerdict::kNoTrack, {}, Clock::now() - begin);
  if (epoch != epoch_) {
    for (const auto& localiser : localisers_) localiser->restart();
    epoch_ = epoch;
  }
  const auto points = pointsOf(scan.beams, scan.mounting, TrackPiece(*way), stamp);
  const ScanMatch match =
      localiser.match(points, *predicted, scan.mounting.T_base_sensor.position());
  MatchVerdict verdict = MatchVerdict::kNoTrack;
  std::optional<std::vector<std::pair<double, Pose2>>> lately;
  bool overtaken = false;
  {
    std::lock_guard<std::mutex> lock(shared_.mutex);
    overtaken = shared_.tracker.epoch() != epoch;
    if (!overtaken) {
      verdict = shared_.tracker.correct(stamp, match);
      lately = shared_.tracker.way(stamp - ScanLag::kWay, stamp);
      if (const auto after = shared_.tracker.at(stamp)) predicted = after;
      std::lock_guard<std::mutex> report_lock(mutex_);
      report_.distance = shared_.tracker.lastDistance();
    }
  }
  if (overtaken) {
    std::lock_guard<std::mutex> lock(mutex_);
    ++report_.overtaken;
    return;
  }
  localiser.learn(verdict, predicted->pose);
  if (verdict == MatchVerdict::kAccepted && lately) {
    localiser.lag().learn(stamp, match, *lately);
  }
  count(verdict, match, Clock::now() - begin);
}

void ScanThread::count(MatchVerdict verdict, const ScanMatch& match, Clock::duration took) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++report_.matches[static_cast<std::size_t>(verdict)];
  if (verdict == MatchVerdict::kAccepted || verdict == MatchVerdict::kRelocated) {
    accepted_ = Clock::now();
  }
  report_.last_ms = seconds(took) * 1e3;
  report_.rms = match.rms;
  report_.overlap = match.overlap;
  report_.mapped = 0;
  for (std::size_t i = 0; i < localisers_.size(); ++i) {
    report_.mapped += localisers_[i]->mapped();
    report_.lags[i] = localisers_[i]->lag().seconds();
  }
}

}  // namespace pilothouse
