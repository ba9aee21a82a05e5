#include "core/pose/scan_lag.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/scan_points.hpp"

namespace pilothouse {
namespace {

constexpr double kApart = 0.5;      // matches that are compared: at least [s]
constexpr double kForgotten = 1.5;  // and at most [s]
// Of odometry between two matches and of the map, beside what the matches say of themselves.
// Neighbouring pairs share a match and what is wrong with the map, so that so many count as one.
constexpr double kPlaceError = 0.015, kTurnError = 0.01;  // [m], [rad]
constexpr double kShared = 3.0;
constexpr double kOutlier = 3.0;  // of those errors: a pair that went wrong
constexpr double kWander = 3e-4;  // of the lag in a second [s]

Eigen::Vector3d vectorOf(const Pose2& pose) {
  return {pose.x, pose.y, pose.heading};
}

/// By odometry, in the base frame; nothing where the way is too short.
std::optional<Twist2> twistAt(double stamp, const std::vector<std::pair<double, Pose2>>& way) {
  if (way.size() < 2) return std::nullopt;
  const TrackPiece track(way);
  const double from = std::max(way.front().first, stamp - ScanLag::kWay), span = stamp - from;
  if (span < 0.5 * ScanLag::kWay) return std::nullopt;
  const Pose2 step = relative(track.at(from), track.at(stamp));
  return Twist2{step.x / span, step.y / span, step.heading / span};
}

}  // namespace

double ScanLag::spread() const {
  return std::sqrt(variance_);
}

void ScanLag::learn(double stamp, const ScanMatch& match,
                    const std::vector<std::pair<double, Pose2>>& way) {
  const auto twist = twistAt(stamp, way);
  if (!twist || !match.pose.finite() || !match.covariance.allFinite()) return;
  if (!sightings_.empty() && stamp <= sightings_.back().stamp) sightings_.clear();
  const Sighting now{stamp, lag_, match.pose, match.covariance, TrackPiece(way).at(stamp), *twist};
  if (!sightings_.empty()) {
    variance_ += kWander * kWander * std::min(1.0, stamp - sightings_.back().stamp);
  }
  while (!sightings_.empty() && stamp - sightings_.front().stamp > kForgotten) {
    sightings_.pop_front();
  }
  const auto before = std::find_if(sightings_.rbegin(), sightings_.rend(),
                                   [&](const Sighting& s) { return stamp - s.stamp >= kApart; });
  if (before != sightings_.rend()) compare(*before, now);
  sightings_.push_back(now);
}

void ScanLag::compare(const Sighting& before, const Sighting& now) {
  // Where odometry stood at the time of the scan, if the lag were another by so much.
  const auto drivenWith = [](const Sighting& s, double lag) {
    return advanced(s.driven, s.twist, s.lag - lag);
  };
  const auto wayWith = [&](double lag) {
    return relative(drivenWith(before, lag), drivenWith(now, lag));
  };
  constexpr double kStep = 0.01;  // [s]
  const Pose2 way = wayWith(lag_);
  const Eigen::Vector3d slope = vectorOf(relative(way, wayWith(lag_ + kStep))) / kStep;
  const Eigen::Vector3d off = vectorOf(relative(way, relative(before.matched, now.matched)));
  // In the base's frame now: of odometry and the map, and of the two matches.
  Eigen::Matrix3d error =
      Eigen::Vector3d(kPlaceError, kPlaceError, kTurnError).cwiseAbs2().asDiagonal();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-now.matched.heading).toRotationMatrix();
  error += turn * (before.covariance + now.covariance) * turn.transpose();
  const Eigen::LDLT<Eigen::Matrix3d> spread(error);
  const double seen = std::sqrt(off.dot(spread.solve(off)));
  const double information = slope.dot(spread.solve(slope)) / kShared;
  if (!(seen <= kOutlier + kMost * std::sqrt(kShared * information))) return;
  variance_ /= 1.0 + variance_ * information;
  lag_ += variance_ * slope.dot(spread.solve(off)) / kShared;
  lag_ = std::clamp(lag_, -kMost, kMost);
}

}  // namespace pilothouse
