#include "gui/model/conversions_drive.hpp"

#include <cmath>

namespace pilothouse::gui {

namespace {

// The console's causes are the messages' numbers.
static_assert(SpeedLimit::FREE == static_cast<int>(LimitCause::kFree));
static_assert(SpeedLimit::OBSTACLE == static_cast<int>(LimitCause::kObstacle));
static_assert(SpeedLimit::POTENTIAL == static_cast<int>(LimitCause::kPotential));
static_assert(SpeedLimit::BRAKING == static_cast<int>(LimitCause::kBraking));
static_assert(SpeedLimit::THRESHOLD == static_cast<int>(LimitCause::kThreshold));
static_assert(SpeedLimit::UNSEEN == static_cast<int>(LimitCause::kUnseen));
static_assert(SpeedLimit::STALE == static_cast<int>(LimitCause::kStale));
static_assert(SpeedLimit::BAD_COMMAND == static_cast<int>(LimitCause::kBadCommand));
static_assert(SpeedLimit::BAD_COMMAND + 1 == kLimitCauses);
static_assert(StopState::NONE == static_cast<int>(StopCause::kNone));
static_assert(StopState::NOT_ARMED == static_cast<int>(StopCause::kNotArmed));
static_assert(StopState::OPERATOR == static_cast<int>(StopCause::kOperator));
static_assert(StopState::STALE_PERCEPTION == static_cast<int>(StopCause::kStalePerception));
static_assert(StopState::STALE_ODOMETRY == static_cast<int>(StopCause::kStaleOdometry));
static_assert(StopState::STALE_COMMAND == static_cast<int>(StopCause::kStaleCommand));
static_assert(StopState::OPERATOR_GONE == static_cast<int>(StopCause::kOperatorGone));
static_assert(StopState::SECOND_PUBLISHER == static_cast<int>(StopCause::kSecondPublisher));
static_assert(StopState::BAD_COMMAND == static_cast<int>(StopCause::kBadCommand));
static_assert(StopState::STALE_LIMIT == static_cast<int>(StopCause::kStaleLimit));
static_assert(StopState::CLOCK == static_cast<int>(StopCause::kClock));

constexpr double kMostSpeed = 1000.0;     // m/s; beyond it a message is garbage
constexpr double kMostDistance = 1.0e4;   // m
constexpr std::size_t kMostNames = 64;    // joints, models touched
constexpr std::size_t kLongestName = 48;  // characters

bool within(double value, double most) {
  return std::abs(value) <= most;  // false for NaN
}
bool withinOrNan(double value, double most) {
  return std::isnan(value) || within(value, most);
}
bool distanceOrInfinite(double value) {
  return within(value, kMostDistance) || (std::isinf(value) && value > 0.0);
}
std::string out(const char* name, double value, const char* expected) {
  return std::string(name) + " is " + std::to_string(value) + ", expected " + expected;
}

std::string faultOf(const SpeedLimit& m) {
  if (m.cause >= kLimitCauses) {
    return "cause " + std::to_string(m.cause) + ", expected 0 to " +
           std::to_string(kLimitCauses - 1);
  }
  if (!within(m.wanted, kMostSpeed)) return out("wanted", m.wanted, "a speed");
  if (!within(m.limited, kMostSpeed)) return out("limited", m.limited, "a speed");
  if (!(m.limit >= 0.0F)) return out("limit", m.limit, "a speed or infinity");
  if (!withinOrNan(m.measured, kMostSpeed)) return out("measured", m.measured, "a speed or NaN");
  if (!std::isnan(m.distance) && !distanceOrInfinite(m.distance)) {
    return out("distance", m.distance, "metres, infinity or NaN");
  }
  for (const double d : {double(m.obstacle_distance), double(m.potential_distance)}) {
    if (!distanceOrInfinite(d)) return out("a free way", d, "metres or infinity");
  }
  if (!withinOrNan(m.position.x, kMostDistance) || !withinOrNan(m.position.y, kMostDistance)) {
    return "position is no place within 10 km";
  }
  return {};
}

// Age of the input that a stale limit names; NaN when it never came.
double staleAge(const SpeedLimit& m) {
  const ros::Time& stamp = m.sensor == "odometry" || m.sensor == "odom" ? m.odometry_stamp
                           : m.sensor == "command"                      ? m.command_stamp
                                                                        : m.perception_stamp;
  if (stamp.isZero()) return kUnknown;
  const double age = m.header.stamp.toSec() - stamp.toSec();
  return within(age, 1e6) ? age : kUnknown;
}

}  // namespace

std::string plainText(const std::string& text, std::size_t most) {
  std::string plain;
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    plain += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  return plain;
}

Checked<LimitReading> limitFromMessage(const SpeedLimit& m) {
  const std::string fault = faultOf(m);
  if (!fault.empty()) return Checked<LimitReading>::refused(fault);
  LimitReading r;
  r.cause = static_cast<LimitCause>(m.cause);
  r.sensor = plainText(m.sensor, kLongestName);
  r.source = plainText(m.source, kLongestName);
  r.distance = double(m.distance);
  r.x = double(m.position.x);
  r.y = double(m.position.y);
  r.limit = double(m.limit);
  r.wanted = double(m.wanted);
  r.limited = double(m.limited);
  r.measured = double(m.measured);
  r.obstacle_distance = double(m.obstacle_distance);
  r.potential_distance = double(m.potential_distance);
  if (r.cause == LimitCause::kStale) r.input_age = staleAge(m);
  return Checked<LimitReading>::of(r);
}

Checked<StopReading> stopFromMessage(const StopState& m) {
  using Result = Checked<StopReading>;
  if (m.state > StopState::STOPPED) {
    return Result::refused("state " + std::to_string(m.state) + ", expected 0 to 2");
  }
  if (m.cause > StopState::CLOCK) {
    return Result::refused("cause " + std::to_string(m.cause) + ", expected 0 to 10");
  }
  StopReading r;
  r.beat = m.beat;
  r.phase = static_cast<GatePhase>(m.state);
  r.cause = static_cast<StopCause>(m.cause);
  r.text = plainText(m.text);
  r.can_arm = m.can_arm != 0;
  r.obstacle_to_arming = plainText(m.obstacle_to_arming);
  r.perception_age = double(m.perception_age);
  r.odometry_age = double(m.odometry_age);
  r.command = {m.command.linear.x, m.command.linear.y, m.command.angular.z};
  if (!within(r.command.vx, kMostSpeed) || !within(r.command.vy, kMostSpeed) ||
      !within(r.command.w, kMostSpeed)) {
    return Result::refused("the command is no finite speed");
  }
  return Result::of(r);
}

Checked<std::vector<WheelReading>> wheelsFromMessage(const sensor_msgs::JointState& joints) {
  using Result = Checked<std::vector<WheelReading>>;
  if (joints.name.size() > kMostNames) {
    return Result::refused(std::to_string(joints.name.size()) + " joints, expected at most " +
                           std::to_string(kMostNames));
  }
  if (joints.velocity.size() != joints.name.size()) {
    return Result::refused(std::to_string(joints.velocity.size()) + " velocities of " +
                           std::to_string(joints.name.size()) + " joints");
  }
  const std::string ending = "_wheel";
  std::vector<WheelReading> wheels;
  for (std::size_t i = 0; i < joints.name.size(); ++i) {
    const std::string& name = joints.name[i];
    if (name.size() <= ending.size() || name.size() > kLongestName ||
        name.compare(name.size() - ending.size(), ending.size(), ending) != 0) {
      continue;
    }
    const double rate = joints.velocity[i];
    wheels.push_back({plainText(name.substr(0, name.size() - ending.size())),
                      within(rate, kMostSpeed) ? rate : kUnknown});
  }
  return Result::of(std::move(wheels));
}

Checked<RangeReading> rangeFromMessage(const sensor_msgs::Range& m) {
  using Result = Checked<RangeReading>;
  if (!(m.max_range > 0.0F && m.max_range <= 100.0F)) {
    return Result::refused(out("max_range", m.max_range, "0 to 100 m"));
  }
  if (!(m.field_of_view >= 0.0F && m.field_of_view <= 6.3F)) {
    return Result::refused(out("field_of_view", m.field_of_view, "0 to a turn"));
  }
  if (std::isnan(m.range)) return Result::refused("range is NaN");
  RangeReading r;
  r.range = double(m.range);
  if (r.range < 0.0) r.range = 0.0;  // REP 117: -infinity, nearer than can be told
  if (r.range > double(m.max_range)) r.range = std::numeric_limits<double>::infinity();
  r.max = double(m.max_range);
  r.field_of_view = double(m.field_of_view);
  return Result::of(r);
}

Checked<ContactsReading> contactsFromMessage(const Contacts& m) {
  ContactsReading r;
  r.count = m.count;
  for (const auto& name : m.touching) {
    if (r.touching.size() == kMostNames) break;
    r.touching.push_back(plainText(name, kLongestName));
  }
  return Checked<ContactsReading>::of(r);
}

Checked<RouteReading> routeFromMessage(const RouteState& m) {
  using Result = Checked<RouteReading>;
  if (m.state > RouteState::REFUSED) {
    return Result::refused("state " + std::to_string(m.state) + ", expected 0 to 4");
  }
  if (!within(m.distance_left, 1e6)) {
    return Result::refused(out("distance_left", m.distance_left, "metres"));
  }
  RouteReading r;
  r.phase = static_cast<RoutePhase>(m.state);
  r.target = m.target;
  r.points = m.points;
  r.distance_left = double(m.distance_left);
  r.text = plainText(m.text);
  return Result::of(r);
}

Checked<WantedReading> wantedFromMessage(const geometry_msgs::TwistStamped& m) {
  WantedReading r;
  r.twist = {m.twist.linear.x, m.twist.linear.y, m.twist.angular.z};
  if (!within(r.twist.vx, kMostSpeed) || !within(r.twist.vy, kMostSpeed) ||
      !within(r.twist.w, kMostSpeed)) {
    return Checked<WantedReading>::refused("a wish to drive that is not finite");
  }
  return Checked<WantedReading>::of(r);
}

}  // namespace pilothouse::gui
