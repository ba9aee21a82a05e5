#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/pose/pose_tracker.hpp"
#include "core/pose/scan_localiser.hpp"
#include "core/pose/scan_points.hpp"

namespace pilothouse {

/// The tracker, shared by the thread of the callbacks and that of the scans. Whoever holds the
/// mutex holds it for microseconds.
struct SharedTracker {
  explicit SharedTracker(const TrackerParameters& parameters) : tracker(parameters) {}
  std::mutex mutex;
  PoseTracker tracker;
};

/// Lays scans upon the map in a thread of its own, so that nobody waits for it: of each scanner the
/// newest scan of those for which odometry tells where the robot was.
class ScanThread {
 public:
  static constexpr std::size_t kVerdicts = static_cast<std::size_t>(MatchVerdict::kNoTrack) + 1;
  struct Report {
    std::array<std::uint64_t, kVerdicts> matches{};  ///< by MatchVerdict
    std::uint64_t overtaken = 0;  ///< scans that a newer one replaced, or a pose set meanwhile
    std::optional<double> accepted_ago;               ///< since the last accepted match [s]
    double last_ms = 0.0;                             ///< what the last match took
    double rms = 0.0, overlap = 0.0, distance = 0.0;  ///< of the last match
    std::size_t mapped = 0;                           ///< points of the map
    std::vector<double> lags;                         ///< of each scanner's stamps, learnt [s]
  };

  ScanThread(SharedTracker& shared, std::vector<std::unique_ptr<ScanLocaliser>> localisers);
  ~ScanThread();

  /// @param source index of the localiser.
  void take(std::size_t source, ScanBeams beams, const ScanMounting& mounting);
  /// From now on scans are laid upon this map.
  void give(MapCells map);
  /// The tracker has newer odometry.
  void wake();
  Report report();

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    ScanBeams beams;
    ScanMounting mounting;
    Clock::time_point arrived;
  };
  void run();
  /// The newest scan whose time odometry has reached, or that waited too long; those before it are
  /// overtaken. @param source of it
  std::optional<Waiting> next(std::size_t& source);
  void localise(std::size_t source, Waiting& scan);
  void count(MatchVerdict verdict, const ScanMatch& match, Clock::duration took);

  SharedTracker& shared_;
  std::vector<std::unique_ptr<ScanLocaliser>> localisers_;  // the thread's alone
  std::uint64_t epoch_ = 0;                                 // the thread's alone

  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false, woken_ = false;
  std::vector<std::deque<Waiting>> waiting_;  ///< of each scanner, the newest last
  std::optional<MapCells> given_;
  Report report_;
  std::optional<Clock::time_point> accepted_;
  std::thread thread_;
};

}  // namespace pilothouse
