#include "core/pose/wheel_scale.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose/pose_algebra.hpp"

namespace pilothouse {
namespace {

constexpr double kApart = 0.5;      // matches that are compared: at least [s]
constexpr double kForgotten = 1.5;  // and at most [s]
constexpr double kLeast = 0.05;     // a way or turn so short tells nothing [m], [rad]
// Of the map, beside what the matches say of themselves, and of wheels that slip by chance.
constexpr double kPlaceError = 0.015, kTurnError = 0.01;  // [m], [rad]
constexpr double kSlip = 0.03, kTurnSlip = 0.05;          // [m/sqrt(m)], [rad/sqrt(rad)]
constexpr double kOutlier = 3.0;                          // of those errors
constexpr double kWander = 0.005;                         // of a scale in a second: floors change
constexpr double kMost = 0.5;                             // off

double squared(double value) {
  return value * value;
}

}  // namespace

void WheelScale::Constant::learn(double counted, double measured, double error_variance) {
  const double off = measured - value * counted;
  const double spread = variance * counted * counted + error_variance;
  if (!(off * off <= kOutlier * kOutlier * spread)) return;
  const double gain = variance * counted / spread;
  value = std::clamp(value + gain * off, 1.0 - kMost, 1.0 + kMost);
  variance *= 1.0 - gain * counted;
}

void WheelScale::learn(double stamp, const ScanMatch& match, const Pose2& odom) {
  const Sighting now{stamp, match.pose, odom, match.covariance};
  if (!before_ || stamp - before_->stamp > kForgotten || stamp < before_->stamp) {
    before_ = now;
    return;
  }
  const double time = stamp - before_->stamp;
  if (time < kApart) return;
  const Pose2 counted = relative(before_->odom, odom);
  const Pose2 measured = relative(before_->matched, match.pose);
  const Eigen::Matrix3d covariance = before_->covariance + match.covariance;
  before_ = now;
  way_.variance += squared(kWander) * time;
  turn_.variance += squared(kWander) * time;
  const double way = counted.position().norm(), turn = std::abs(counted.heading);
  if (way > kLeast) {
    way_.learn(
        way, measured.position().dot(counted.position()) / way,
        covariance.topLeftCorner<2, 2>().trace() + squared(kPlaceError) + squared(kSlip) * way);
  }
  if (turn > kLeast) {
    turn_.learn(counted.heading, measured.heading,
                covariance(2, 2) + squared(kTurnError) + squared(kTurnSlip) * turn);
  }
}

}  // namespace pilothouse
