// The thread that lays scans upon the map: which of those that wait it takes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

#include "nodelets/scan_thread.hpp"
#include "registration/icp_matcher.hpp"

namespace pilothouse {
namespace {

ScanBeams roundWall(double stamp) {
  return {stamp, -3.14, 0.0174, 0.0, 0.1, 10.0, std::vector<float>(360, 2.0F)};
}

std::uint64_t matched(const ScanThread::Report& report) {
  const auto no_track = report.matches[static_cast<std::size_t>(MatchVerdict::kNoTrack)];
  return std::accumulate(report.matches.begin(), report.matches.end(), std::uint64_t{0}) - no_track;
}

TEST(ScanThread, MatchesScansThatComeFasterThanOdometryFollows) {
  // A laser 40 times a second, and odometry that is always 30 ms behind it: each scan waits until
  // after the next one came.
  SharedTracker shared({});
  std::vector<std::unique_ptr<ScanLocaliser>> localisers;
  localisers.push_back(
      std::make_unique<ScanLocaliser>(LocaliserParameters{}, std::make_unique<IcpMatcher>()));
  ScanThread thread(shared, std::move(localisers));
  for (int i = 0; i < 20; ++i) {
    const double now = 0.025 * i;
    thread.take(0, roundWall(now), {});
    {
      const std::lock_guard<std::mutex> lock(shared.mutex);
      shared.tracker.addOdometry(now - 0.03, {});
    }
    thread.wake();
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (thread.report().matches == ScanThread::Report{}.matches &&
         std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_GT(matched(thread.report()), 0U);
}

}  // namespace
}  // namespace pilothouse
