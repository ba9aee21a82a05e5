#include "core/pose/pose_tracker.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/pose/pose_algebra.hpp"

namespace pilothouse {
namespace {

constexpr double kKept = 5.0;      // history [s]
constexpr double kTimeBack = 0.5;  // odometry so much older than the newest: time ran back [s]
constexpr double kFastest = 20.0;  // no base drives faster [m/s], nor turns
constexpr double kJump = 0.5;      // nor jumps so far, however long nothing came [m, rad] a second
constexpr double kStandingStill = 1e-5;  // a step so small is none [m, rad]
constexpr double kFarthest = 1e5;        // of a pose in a map [m]
constexpr double kConstant = 5.0;        // over so long a gyroscope's constant error is one [s]
// Wheels that slip are wrong again and again: each match so surprising (squared Mahalanobis
// distance; 1 right one in 100) makes odometry's variance larger, each other one less so.
constexpr double kSurprise = 11.3, kDoubt = 2.0, kTrust = 0.9, kMostSlip = 9.0;
// Before matches are believed against odometry: at least so many, none later than so after another
// [s], and so much of each scan found in the map.
constexpr int kFewestAgreeing = 10;
constexpr double kLongestGap = 1.0, kSureOverlap = 0.6;
constexpr double kSameShift = 0.1;  // matches that ask for shifts so alike agree [m, rad]
const Eigen::Vector3d kFirstSpread(1e-3, 1e-3, 1e-3);

bool isFinite(const PoseEstimate& e) {
  return std::isfinite(e.stamp) && e.pose.finite() && std::abs(e.pose.x) <= kFarthest &&
         std::abs(e.pose.y) <= kFarthest;
}

Eigen::Vector3d differenceOf(const Pose2& a, const Pose2& b) {
  return {a.x - b.x, a.y - b.y, wrapped(a.heading - b.heading)};
}

}  // namespace

const char* nameOf(MatchVerdict verdict) {
  switch (verdict) {
    case MatchVerdict::kAccepted:
      return "accepted";
    case MatchVerdict::kRelocated:
      return "relocated";
    case MatchVerdict::kNotFound:
      return "not found";
    case MatchVerdict::kPoorFit:
      return "poor fit";
    case MatchVerdict::kLittleOverlap:
      return "little overlap";
    case MatchVerdict::kUncertain:
      return "uncertain";
    case MatchVerdict::kUnlikely:
      return "unlikely";
    case MatchVerdict::kNoTrack:
      return "no odometry";
  }
  return "?";
}

std::vector<std::string> validate(const TrackerParameters& parameters) {
  std::vector<std::string> faults;
  forEachTrackerParameter(parameters, [&faults](const char* key, auto value, auto low, auto high) {
    if (value >= low && value <= high) return;
    std::ostringstream text;
    text << key << " is " << value << ", expected " << low << " to " << high;
    faults.push_back(text.str());
  });
  return faults;
}

PoseTracker::Step PoseTracker::stepTo(double stamp, const Pose2& T_odom_base) {
  const Entry& last = entries_.back();
  Step step{relative(last.odom, T_odom_base), 0.0};
  const double way = step.delta.position().norm(), turn = std::abs(step.delta.heading);
  const bool still = way < kStandingStill && turn < kStandingStill;
  step.delta.x *= scale_.way();
  step.delta.y *= scale_.way();
  step.delta.heading *= scale_.turn();
  // A scale that is not known well errs by itself on each radian alike.
  const double turn_error = parameters_.turn_error * parameters_.turn_error + scale_.turnVariance();
  const double wheels =
      slip_ * (parameters_.way_turn_error * parameters_.way_turn_error * way + turn_error * turn);
  step.turn_variance = wheels;
  if (still) {
    gyro_.stood(last.stamp, stamp);
    return step;
  }
  const auto turned = gyro_.turned(last.stamp, stamp);
  if (!turned) return step;
  gyro_.rolled(last.stamp, stamp, step.delta.heading, wheels);
  const double gyro =
      (parameters_.gyro_error * parameters_.gyro_error + kConstant * gyro_.biasVariance()) *
      (stamp - last.stamp);
  step.delta.heading = wrapped(step.delta.heading +
                               wheels / (wheels + gyro) * wrapped(*turned - step.delta.heading));
  step.turn_variance = wheels * gyro / (wheels + gyro);
  return step;
}

Eigen::Matrix3d PoseTracker::grown(const Eigen::Matrix3d& covariance, const Pose2& from,
                                   const Pose2& to, double turn_variance) const {
  const Eigen::Vector2d way = to.position() - from.position();
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = -way.y();
  jacobian(1, 2) = way.x();
  const double length = way.norm();
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  if (length > 0.0) {
    const Eigen::Vector2d along = way / length, across(-along.y(), along.x());
    noise.topLeftCorner<2, 2>() =
        slip_ * length *
        ((parameters_.way_error * parameters_.way_error + scale_.wayVariance()) * along *
             along.transpose() +
         parameters_.side_error * parameters_.side_error * across * across.transpose());
  }
  noise(2, 2) = turn_variance;
  return jacobian * covariance * jacobian.transpose() + noise;
}

OdometryVerdict PoseTracker::addOdometry(double stamp, const Pose2& T_odom_base) {
  if (!std::isfinite(stamp) || !T_odom_base.finite()) return OdometryVerdict::kNotFinite;
  if (entries_.empty()) {
    Entry first{stamp, T_odom_base, Pose2{}, T_odom_base, kFirstSpread.cwiseAbs2().asDiagonal(),
                0.0};
    if (pending_) {
      first.map = pending_->pose;
      first.covariance = pending_->covariance;
      pending_.reset();
    }
    entries_.push_back(first);
    return OdometryVerdict::kTaken;
  }
  auto verdict = OdometryVerdict::kTaken;
  Entry last = entries_.back();
  const double dt = stamp - last.stamp;
  if (dt <= 0.0 && dt > -kTimeBack) return OdometryVerdict::kOld;
  const Pose2 moved = relative(last.odom, T_odom_base);
  const double most = kJump + kFastest * std::max(0.0, dt);
  const bool jumped = moved.position().norm() > most || std::abs(moved.heading) > most;
  if (dt < 0.0) {
    // A clock that was set back while the robot stands leaves it where it is; a recording that
    // begins anew does not.
    verdict = OdometryVerdict::kTimeBack;
    const bool same = moved.position().norm() < kJump && std::abs(moved.heading) < kJump;
    if (!same) last.map = T_odom_base, last.covariance = kFirstSpread.cwiseAbs2().asDiagonal();
    entries_.assign(1, {stamp, T_odom_base, last.reckoned, last.map, last.covariance, 0.0});
    gyro_.clear();
    scale_.restart();
    jumped_at_ = stamp;
    refused_ = 0;
    ++epoch_;
    return verdict;
  }
  if (jumped) {
    jumped_at_ = stamp;
    scale_.restart();
    entries_.push_back({stamp, T_odom_base, last.reckoned, last.map, last.covariance, 0.0});
    verdict = OdometryVerdict::kJumped;
  } else {
    const Step step = stepTo(stamp, T_odom_base);
    const Pose2 map = composed(last.map, step.delta);
    entries_.push_back({stamp, T_odom_base, composed(last.reckoned, step.delta), map,
                        grown(last.covariance, last.map, map, step.turn_variance),
                        step.turn_variance});
  }
  while (entries_.size() > 2 && stamp - entries_.front().stamp > kKept) entries_.pop_front();
  return verdict;
}

PoseEstimate PoseTracker::newest() const {
  const Entry& last = entries_.back();
  return {last.stamp, last.map, last.covariance};
}

Pose2 PoseTracker::correction() const {
  const Entry& last = entries_.back();
  return composed(last.map, inverse(last.odom));
}

std::optional<std::pair<std::size_t, PoseEstimate>> PoseTracker::find(double stamp) const {
  if (entries_.empty() || !(stamp >= entries_.front().stamp && stamp <= entries_.back().stamp)) {
    return std::nullopt;
  }
  const auto after =
      std::lower_bound(entries_.begin(), entries_.end(), stamp,
                       [](const Entry& e, double wanted) { return e.stamp < wanted; });
  const auto next = static_cast<std::size_t>(after - entries_.begin());
  if (next == 0) return std::make_pair(next, PoseEstimate{stamp, after->map, after->covariance});
  const Entry& before = entries_[next - 1];
  const double share = (stamp - before.stamp) / (after->stamp - before.stamp);
  const Pose2 pose = between(before.map, after->map, share);
  return std::make_pair(
      next, PoseEstimate{stamp, pose,
                         grown(before.covariance, before.map, pose, share * after->turn_variance)});
}

std::optional<PoseEstimate> PoseTracker::at(double stamp) const {
  const auto found = find(stamp);
  return found ? std::make_optional(found->second) : std::nullopt;
}

std::optional<std::vector<std::pair<double, Pose2>>> PoseTracker::way(double from,
                                                                      double to) const {
  if (!(from <= to) || !find(from) || !find(to)) return std::nullopt;
  std::vector<std::pair<double, Pose2>> way;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const bool last_before = i + 1 < entries_.size() && entries_[i + 1].stamp <= from;
    if (!last_before) way.emplace_back(entries_[i].stamp, entries_[i].reckoned);
    if (entries_[i].stamp >= to) break;
  }
  return way;
}

void PoseTracker::replace(std::size_t next, const PoseEstimate& before, const PoseEstimate& after) {
  Pose2 old_from = before.pose, from = after.pose;
  Eigen::Matrix3d covariance = after.covariance;
  double stamp = before.stamp;
  for (std::size_t i = next; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    const double whole = i > 0 ? entry.stamp - entries_[i - 1].stamp : 0.0;
    const double share = whole > 0.0 ? std::min(1.0, (entry.stamp - stamp) / whole) : 0.0;
    const Pose2 to = composed(from, relative(old_from, entry.map));
    covariance = grown(covariance, from, to, share * entry.turn_variance);
    old_from = entry.map;
    entry.map = from = to;
    entry.covariance = covariance;
    stamp = entry.stamp;
  }
}

std::optional<std::string> PoseTracker::setPose(const PoseEstimate& wanted) {
  if (!isFinite(wanted)) {
    return "the pose is not finite or farther than 100 km from the map's origin";
  }
  if (!wanted.covariance.allFinite()) return "the covariance is not finite";
  const double scale = std::max(1.0, wanted.covariance.cwiseAbs().maxCoeff());
  if ((wanted.covariance - wanted.covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale) {
    return "the covariance is not symmetric";
  }
  if (scale > kFarthest * kFarthest) {
    return "the covariance is larger than that of a pose anywhere within 100 km";
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(wanted.covariance);
  if (axes.eigenvalues()(0) < -1e-9 * scale) {
    return "the covariance is not positive semidefinite: least eigenvalue " +
           std::to_string(axes.eigenvalues()(0));
  }
  PoseEstimate estimate = wanted;
  estimate.pose.heading = wrapped(wanted.pose.heading);
  // Nobody sets a pose exactly; a filter that believed so would never move again.
  estimate.covariance += Eigen::Matrix3d(kFirstSpread.cwiseAbs2().asDiagonal());
  refused_ = 0;
  scale_.restart();
  ++epoch_;
  if (entries_.empty()) {
    pending_ = estimate;
    return std::nullopt;
  }
  const bool inside =
      estimate.stamp >= entries_.front().stamp && estimate.stamp <= entries_.back().stamp;
  const auto [next, before] = find(inside ? estimate.stamp : entries_.back().stamp).value();
  replace(next, before, estimate);
  // Scans from before belong to the pose that was wrong.
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(next));
  return std::nullopt;
}

bool PoseTracker::agreesWithRefused(const PoseEstimate& predicted, const ScanMatch& match) {
  const Pose2 shift = composed(match.pose, inverse(predicted.pose));
  const Eigen::Vector2d here = shift * predicted.pose.position();
  const bool same = refused_ > 0 && std::abs(predicted.stamp - refused_last_) < kLongestGap &&
                    (refused_shift_ * predicted.pose.position() - here).norm() < kSameShift &&
                    std::abs(wrapped(shift.heading - refused_shift_.heading)) < kSameShift;
  if (!same) {
    refused_shift_ = shift;
    refused_since_ = predicted.stamp;
    refused_ = 0;
  }
  refused_last_ = predicted.stamp;
  return ++refused_ >= kFewestAgreeing &&
         predicted.stamp - refused_since_ >= parameters_.widen_after &&
         match.overlap >= kSureOverlap;
}

MatchVerdict PoseTracker::judge(const PoseEstimate& predicted, const ScanMatch& match) {
  if (!match.found || !match.pose.finite() || !match.covariance.allFinite()) {
    return MatchVerdict::kNotFound;
  }
  if (!(match.overlap >= parameters_.min_overlap)) return MatchVerdict::kLittleOverlap;
  if (!(match.rms <= parameters_.max_rms)) return MatchVerdict::kPoorFit;
  const double limit = parameters_.max_spread * parameters_.max_spread;
  if (!(match.covariance.diagonal().maxCoeff() <= limit)) return MatchVerdict::kUncertain;
  const Eigen::Vector3d innovation = differenceOf(match.pose, predicted.pose);
  const Eigen::LDLT<Eigen::Matrix3d> spread(predicted.covariance + match.covariance);
  last_distance_ = innovation.dot(spread.solve(innovation));
  slip_ = last_distance_ > kSurprise ? std::min(kMostSlip, kDoubt * slip_)
                                     : std::max(1.0, kTrust * slip_);
  if (last_distance_ >= 0.0 && last_distance_ <= parameters_.gate) return MatchVerdict::kAccepted;
  return agreesWithRefused(predicted, match) ? MatchVerdict::kRelocated : MatchVerdict::kUnlikely;
}

MatchVerdict PoseTracker::correct(double stamp, const ScanMatch& match) {
  const auto found = find(stamp);
  if (!found) return MatchVerdict::kNoTrack;
  const PoseEstimate& predicted = found->second;
  const MatchVerdict verdict = judge(predicted, match);
  if (verdict != MatchVerdict::kAccepted && verdict != MatchVerdict::kRelocated) return verdict;
  refused_ = 0;
  PoseEstimate after{stamp, match.pose, match.covariance};
  if (verdict == MatchVerdict::kAccepted) {
    const Eigen::Vector3d innovation = differenceOf(match.pose, predicted.pose);
    const Eigen::Matrix3d gain =
        predicted.covariance * (predicted.covariance + match.covariance).inverse();
    const Eigen::Vector3d shift = gain * innovation;
    after.pose = {predicted.pose.x + shift.x(), predicted.pose.y + shift.y(),
                  wrapped(predicted.pose.heading + shift.z())};
    // Joseph's form stays positive.
    const Eigen::Matrix3d left = Eigen::Matrix3d::Identity() - gain;
    after.covariance =
        left * predicted.covariance * left.transpose() + gain * match.covariance * gain.transpose();
  }
  if (verdict == MatchVerdict::kRelocated) scale_.restart();
  if (verdict == MatchVerdict::kAccepted && stamp > jumped_at_) {
    scale_.learn(stamp, match, odometryAt(found->first, stamp));
  }
  replace(found->first, predicted, after);
  return verdict;
}

Pose2 PoseTracker::odometryAt(std::size_t next, double stamp) const {
  if (next == 0) return entries_.front().odom;
  const Entry &before = entries_[next - 1], &after = entries_[next];
  return between(before.odom, after.odom, (stamp - before.stamp) / (after.stamp - before.stamp));
}

}  // namespace pilothouse
