#include "nodelets/avoidance_loop.hpp"

#include <ros/console.h>

#include <cmath>
#include <limits>

#include "doors/motion_views.hpp"
#include "doors/steady_clock.hpp"

namespace pilothouse {
namespace {

constexpr double kJitter = 0.1;         // time that goes back by more has jumped [s]
constexpr double kObjectsPeriod = 0.1;  // of the lists while no grid comes [s]
constexpr double kMoving = 0.02;        // what is seen changes from this speed on [m/s, rad/s]
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A stamp that lies ahead would never grow old.
bool isAhead(double stamp) {
  return !(stamp <= ros::Time::now().toSec() + kJitter);
}

/// A name from outside, which may be long.
std::string shown(const std::string& name) {
  return '"' + name.substr(0, 64) + '"';
}

double ageOf(double stamp, double now) {
  return stamp > 0.0 ? now - stamp : kInfinite;
}

}  // namespace

AvoidanceLoop::AvoidanceLoop(const RobotDescription& robot, ros::NodeHandle& handle,
                             const Frames& frames)
    : frames_(frames),
      merger_(robot.avoidance, robot.outline(), rangersOf(robot)),
      limiter_(robot.avoidance, robot.drive, robot.outline()),
      outputs_(handle, frames.base),
      last_step_(steadyNow()) {}

void AvoidanceLoop::setParameters(const AvoidanceParameters& parameters) {
  limiter_.setParameters(parameters);
  merger_.setParameters(parameters);
}

void AvoidanceLoop::clear() {
  ROS_WARN("Avoidance: time jumped back, starting afresh");
  merger_.clear();
  limiter_.reset();
  commands_.clear();
  odometry_stamp_ = 0.0;
}

void AvoidanceLoop::noticeTime(double now) {
  if (now + kJitter < last_now_) clear();
  last_now_ = now;
}

std::string AvoidanceLoop::take(const FloorGrid& grid) {
  if (grid.header.frame_id != frames_.base) return "a grid in another frame than " + frames_.base;
  const auto frame = openGrid(grid, classes_);
  if (!frame) return frame.reason();
  const bool moving = measured_.linear() + std::abs(measured_.w) > kMoving;
  if (frozen_.repeats(grid) && moving) return "the same as the one before, though the robot moves";
  if (!merger_.floor(*frame)) return "the base's pose at the grid's stamp is not known";
  new_grid_ = true;
  return {};
}

std::string AvoidanceLoop::take(const nav_msgs::Odometry& odometry) {
  const auto motion = openOdometry(odometry);
  if (!motion) return motion.reason();
  if (odometry.header.frame_id != frames_.odometry || odometry.child_frame_id != frames_.base) {
    return "of " + shown(odometry.child_frame_id) + " in " + shown(odometry.header.frame_id) +
           ", expected of \"" + frames_.base + "\" in \"" + frames_.odometry + "\"";
  }
  const double stamp = odometry.header.stamp.toSec();
  if (isAhead(stamp)) return "stamped ahead of the clock";
  if (stamp + kJitter < odometry_stamp_) clear();
  if (!merger_.odometry(stamp, motion->pose, motion->twist)) return "older than the one before";
  odometry_stamp_ = stamp;
  measured_ = motion->twist;
  return {};
}

std::string AvoidanceLoop::take(std::size_t ranger, const sensor_msgs::Range& range) {
  const auto reading = openReading(range);
  if (!reading) return reading.reason();
  const double stamp = range.header.stamp.toSec();
  if (isAhead(stamp)) return "stamped ahead of the clock";
  if (merger_.range(ranger, stamp, *reading)) return {};
  return "a reading that means nothing, or is no newer than the one before";
}

std::string AvoidanceLoop::take(CommandChoice::Source source,
                                const geometry_msgs::TwistStamped& command) {
  const auto twist = openCommand(command);
  // A wish that is not finite is a wish to stop, and counted.
  const bool newer =
      commands_.take(source, twist ? *twist : Twist2{}, command.header.stamp.toSec(), steadyNow());
  if (!twist) return twist.reason();
  return newer ? std::string() : "no newer than the one before";
}

AvoidanceStamps AvoidanceLoop::stamps(double now) const {
  AvoidanceStamps stamps;
  stamps.odometry = odometry_stamp_;
  stamps.perception = kInfinite;
  for (const auto& source : surroundings_.sources) {
    if (source.stamp >= stamps.perception) continue;
    stamps.perception = source.stamp;
    stamps.oldest = source.name;
  }
  stamps.odometry_stale = !(ageOf(odometry_stamp_, now) <= limiter_.parameters().input_timeout);
  return stamps;
}

void AvoidanceLoop::step() {
  const double now = ros::Time::now().toSec(), steady = steadyNow();
  noticeTime(now);
  surroundings_ = merger_.merge(now);
  const AvoidanceStamps stamps = this->stamps(now);
  const CommandChoice::Wish wish = commands_.choose(steady);
  const auto pose = merger_.pose(now);
  LimiterInput input;
  // From standstill a step that comes late makes up for nothing.
  input.dt = stopped_ ? 0.0 : steady - last_step_;
  last_step_ = steady;
  input.wanted = wish.twist;
  input.command_age = wish.age;
  input.measured = measured_;
  // Without a pose for now nothing that was seen can be placed: unknown means stop.
  input.odometry_age = pose ? ageOf(odometry_stamp_, now) : kInfinite;
  input.perception_age = ageOf(stamps.perception, now);
  if (stopped_) limiter_.reset();
  const SpeedLimiter::Looked looked = [&](const Eigen::Vector2d& place) {
    return pose && merger_.memory().looked(*pose * place, now);
  };
  const LimitedCommand limited = limiter_.step(input, surroundings_, looked);
  outputs_.publish(now, limited, wish, stamps, surroundings_);
  if (!new_grid_ && steady - last_objects_ < kObjectsPeriod) return;
  new_grid_ = false;
  last_objects_ = steady;
  outputs_.publish(surroundings_);
}

}  // namespace pilothouse
