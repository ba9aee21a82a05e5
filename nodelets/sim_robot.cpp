#include "nodelets/sim_robot.hpp"

namespace pilothouse {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

}  // namespace

sim::SimRobot simRobotOf(const RobotDescription& robot) {
  sim::SimRobot simulated{robot.name, robot.outline()};
  simulated.height = robot.height;
  simulated.base = robot.drive;
  simulated.T_base_camera = bodyPose(robot.camera) * opticalRotation();
  for (const RangerOnRobot& ranger : robot.rangers) {
    simulated.rangers.push_back({ranger.name, rangerPose(ranger),
                                 ranger.field_of_view_deg * kRadians, ranger.min_range,
                                 ranger.max_range});
  }
  return simulated;
}

}  // namespace pilothouse
