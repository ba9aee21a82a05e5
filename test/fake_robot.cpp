// The driving side of a robot as the console sees it: a gate that can be armed and stopped, a
// limiter before something that comes nearer and goes away, wheels, rangers, objects.
// fake_robot [--task]: with it a task drives, else whoever sends cmd_vel/teleop.

#include <geometry_msgs/TwistStamped.h>
#include <pilothouse/Contacts.h>
#include <pilothouse/ObjectList.h>
#include <pilothouse/Operator.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace {

using pilothouse::Object;
using pilothouse::SpeedLimit;
using pilothouse::StopState;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class FakeRobot {
 public:
  explicit FakeRobot(bool task) : task_(task) {
    stop_.state = StopState::STOPPED;
    stop_.cause = StopState::NOT_ARMED;
    stop_.can_arm = true;
  }

  void step(double now) {
    const double dt = std::clamp(now - at_, 0.0, 0.1);
    at_ = now;
    // Something stands in the way for a while, then leaves; beside it something always.
    const double phase = std::fmod(now, 16.0);
    const double distance = phase < 10.0 ? std::max(0.28, 2.4 - 0.25 * phase) : kInfinity;
    const bool fresh = task_ || now - heard_at_ < 0.5;
    const double wanted = task_   ? 0.4
                          : fresh ? std::hypot(wish_.twist.linear.x, wish_.twist.linear.y)
                                  : 0.0;
    double limit = 0.6;
    limit_.cause = SpeedLimit::FREE;
    if (distance < 0.75) {
      limit = std::max(0.0, 1.2 * (distance - 0.30));
      limit_.cause = SpeedLimit::OBSTACLE;
    } else if (distance < 1.6) {
      limit = 0.22;
      limit_.cause = SpeedLimit::POTENTIAL;
    }
    const bool runs = stop_.state != StopState::STOPPED;
    const double limited = runs ? std::min(wanted, limit) : 0.0;
    measured_ += (limited - measured_) * std::min(1.0, dt / 0.25);
    limit_.limit = static_cast<float>(limit);
    limit_.wanted = static_cast<float>(wanted);
    limit_.limited = static_cast<float>(limited);
    limit_.measured = static_cast<float>(measured_ + 0.006 * std::sin(31.0 * now));
    limit_.sensor = limit_.cause == SpeedLimit::OBSTACLE ? "front" : "camera";
    limit_.distance = static_cast<float>(distance);
    limit_.position.x = static_cast<float>(0.25 + distance);
    limit_.obstacle_distance = static_cast<float>(distance);
    limit_.potential_distance = static_cast<float>(0.9 + 0.3 * std::sin(0.5 * now));
    limit_.source = task_ ? "task" : fresh ? "teleop" : "";
    if (limit_.cause == SpeedLimit::FREE) limit_.position.x = limit_.distance = NAN;
    distance_ = distance;
    if (runs) stop_.state = fresh ? StopState::RUNNING : StopState::IDLE;
  }

  void hear(const pilothouse::Operator& beat) {
    if (beat.stop) halt(StopState::OPERATOR);
    stop_pressed_ = beat.stop != 0;
    stop_.can_arm = !stop_pressed_;
    stop_.obstacle_to_arming = stop_pressed_ ? "the operator's stop is pressed" : "";
  }
  void hear(const geometry_msgs::TwistStamped& wish) {
    wish_ = wish;
    heard_at_ = at_;
  }
  bool arm(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& answer) {
    answer.success = !stop_pressed_;
    answer.message = stop_.obstacle_to_arming;
    if (!stop_pressed_) {
      stop_.state = StopState::IDLE;
      stop_.cause = StopState::NONE;
    }
    return true;
  }

  const SpeedLimit& limit() const { return limit_; }
  StopState& stop() { return stop_; }
  double measured() const { return measured_; }
  double distance() const { return distance_; }

 private:
  void halt(std::uint8_t cause) {
    stop_.state = StopState::STOPPED;
    stop_.cause = cause;
  }

  bool task_, stop_pressed_ = false;
  double at_ = 0.0, heard_at_ = -1e9, measured_ = 0.0, distance_ = 0.0;
  geometry_msgs::TwistStamped wish_;
  SpeedLimit limit_;
  StopState stop_;
};

pilothouse::ObjectList objectsAt(double distance) {
  pilothouse::ObjectList list;
  list.header.frame_id = "base_link";
  list.source = "merged";
  const auto add = [&](double x, double y, double z, std::uint8_t relevance, bool remembered) {
    Object object;
    object.position.x = static_cast<float>(x);
    object.position.y = static_cast<float>(y);
    object.position.z = static_cast<float>(z);
    object.size = 0.05F;
    object.kind = Object::OBSTACLE;
    object.relevance = relevance;
    object.remembered = remembered;
    object.nearest_in_row = true;
    list.objects.push_back(object);
  };
  for (int i = 0; i < 9; ++i) {
    if (std::isfinite(distance)) {
      add(0.27 + distance, -0.2 + 0.05 * i, 0.3, Object::IN_THE_WAY, false);
    }
    add(1.1 + 0.05 * i, 0.36, 0.15, Object::POTENTIAL, false);
    add(1.5 + 0.05 * i, -0.9, i < 4 ? 0.8 : 0.2, Object::OTHER, false);
    add(0.1 + 0.05 * i, 0.52, 0.2, i < 5 ? Object::POTENTIAL : Object::OTHER, true);
  }
  return list;
}

sensor_msgs::Range rangeOf(const std::string& name, double metres) {
  sensor_msgs::Range range;
  range.header.frame_id = "range_" + name;
  range.field_of_view = 0.52F;
  range.min_range = 0.03F;
  range.max_range = 3.0F;
  range.range = static_cast<float>(metres);
  return range;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "fake_robot");
  ros::NodeHandle nh;
  FakeRobot robot(argc > 1 && std::string(argv[1]) == "--task");
  auto limit_pub = nh.advertise<SpeedLimit>("speed_limit", 5);
  auto stop_pub = nh.advertise<StopState>("stop_state", 5);
  auto joints_pub = nh.advertise<sensor_msgs::JointState>("joint_states", 5);
  auto front_pub = nh.advertise<sensor_msgs::Range>("range/front", 5);
  auto rear_pub = nh.advertise<sensor_msgs::Range>("range/rear", 5);
  auto objects_pub = nh.advertise<pilothouse::ObjectList>("objects/filtered", 5);
  const auto operator_sub = nh.subscribe<pilothouse::Operator>(
      "operator", 20, [&](const auto& beat) { robot.hear(*beat); });
  const auto teleop_sub = nh.subscribe<geometry_msgs::TwistStamped>(
      "cmd_vel/teleop", 20, [&](const auto& wish) { robot.hear(*wish); });
  const auto arm = nh.advertiseService("stop_gate/arm", &FakeRobot::arm, &robot);
  sensor_msgs::JointState joints;
  joints.name = {"front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel",
                 "front_left_steering"};
  joints.velocity.resize(5);
  const double start = ros::WallTime::now().toSec();
  ros::WallRate rate(50);
  for (int tick = 0; ros::ok(); ++tick) {
    const double now = ros::WallTime::now().toSec() - start;
    robot.step(now);
    auto limit = robot.limit();
    auto objects = objectsAt(robot.distance());
    limit.header.stamp = objects.header.stamp = robot.stop().header.stamp = ros::Time::now();
    ++robot.stop().beat;
    stop_pub.publish(robot.stop());
    limit_pub.publish(limit);
    for (std::size_t i = 0; i < 4; ++i) {
      joints.velocity[i] =
          robot.measured() / 0.075 * (1.0 + 0.02 * std::sin(9.0 * now + double(i)));
    }
    joints_pub.publish(joints);
    if (tick % 3 == 0) {
      front_pub.publish(rangeOf("front", robot.distance()));
      rear_pub.publish(rangeOf("rear", 1.7 + 0.05 * std::sin(now)));
      objects_pub.publish(objects);
    }
    ros::spinOnce();
    rate.sleep();
  }
}
