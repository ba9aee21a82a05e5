#include "sim/robot_base.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::sim {
namespace {

constexpr double kReach = 0.05;     ///< what is farther cannot be touched within a step [m]
constexpr double kTouch = 0.001;    ///< nearer than this is touched [m]
constexpr double kRelease = 0.010;  ///< and until it is this far away [m]
constexpr double kDeeper = 1e-9;    // [m]
constexpr double kClosing = 0.005;  ///< slower closing in is rounding and slip [m/s]

}  // namespace

RobotBase::RobotBase(const SimRobot& robot, const BaseNoise& noise, std::uint64_t seed)
    : robot_(robot), noise_(noise), random_(seed), drive_(robot.base), ground_(robot) {}

void RobotBase::place(const WorldScene& scene, const Pose2& pose, double from_z) {
  drive_.forgetCommand();
  drive_.block();
  twist_ = {};
  pose_ = pose;
  stance_ = ground_.putDown(scene, pose, from_z);
  touching_.clear();
  if (stance_.drop) contacts_.push_back({kNoModel, 0.0, 0.0});
}

void RobotBase::step(const WorldScene& scene, double now, double dt) {
  drive_.step(now, dt);
  if (stance_.drop) drive_.block();
  const Twist2 wish = slipped(drive_.twist(), dt);
  surroundings_.collect(scene, robot_, stance_.T_world_base, kReach + wish.linear() * dt);
  const double share = surroundings_.near().empty() ? 1.0 : freeShare(wish, dt);
  noteTouched(wish, share, now, dt);
  if (share < 1.0) drive_.block();
  twist_ = share * wish;
  if (twist_.zero()) return;

  const Pose2 moved = advanced({}, twist_, dt);
  // What the robot drives up a slope is shorter seen from above.
  const Eigen::Vector3d at = stance_.T_world_base * Eigen::Vector3d(moved.x, moved.y, 0.0);
  pose_ = {at.x(), at.y(), wrapped(pose_.heading + moved.heading)};
  stance_ = ground_.moveOn(scene, pose_, stance_, drive_.wheels());
  if (stance_.drop) {
    contacts_.push_back({kNoModel, now, twist_.linear()});
    drive_.block();
    twist_ = {};
  }
}

/// First-order Gauss-Markov errors.
Twist2 RobotBase::slipped(const Twist2& rolled, double dt) {
  const double kept = std::exp(-dt / noise_.time);
  const double fresh = std::sqrt(1.0 - kept * kept);
  for (double& slip : slips_) slip = kept * slip + fresh * random_.normal();
  const double faster = 1.0 + noise_.slip * slips_[0], aside = noise_.sideways * slips_[1];
  return {
      faster * rolled.vx - aside * rolled.vy, faster * rolled.vy + aside * rolled.vx,
      (1.0 + noise_.slip * slips_[2]) * rolled.w + noise_.turning * slips_[3] * rolled.linear()};
}

double RobotBase::freeShare(const Twist2& twist, double dt) const {
  const auto free = [&](double share) {
    const Pose2 pose = advanced({}, twist, share * dt);
    return std::all_of(surroundings_.near().begin(), surroundings_.near().end(),
                       [&](const Surroundings::Near& near) {
                         const double after = separation(robot_.footprint, pose, near.slice);
                         if (after >= 0.0) return true;
                         const double before = separation(robot_.footprint, {}, near.slice);
                         return after >= std::min(0.0, before) - kDeeper;
                       });
  };
  if (twist.zero() || free(1.0)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 6; ++i) {
    const double middle = 0.5 * (low + high);
    (free(middle) ? low : high) = middle;
  }
  return low;
}

void RobotBase::noteTouched(const Twist2& wish, double share, double now, double dt) {
  touched_before_ = touching_;
  touching_.clear();
  const Pose2 next = advanced({}, wish, dt), reached = advanced({}, wish, share * dt);
  for (const auto& near : surroundings_.near()) {
    const bool known =
        std::binary_search(touched_before_.begin(), touched_before_.end(), near.model);
    if (separation(robot_.footprint, reached, near.slice) > (known ? kRelease : kTouch)) continue;
    const auto place = std::lower_bound(touching_.begin(), touching_.end(), near.model);
    if (place != touching_.end() && *place == near.model) continue;
    touching_.insert(place, near.model);
    if (known) continue;
    const double closing = (separation(robot_.footprint, {}, near.slice) -
                            separation(robot_.footprint, next, near.slice)) /
                           dt;
    contacts_.push_back({near.model, now, closing > kClosing ? closing : 0.0});
  }
}

}  // namespace pilothouse::sim
