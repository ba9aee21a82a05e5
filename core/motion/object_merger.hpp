#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/local_memory.hpp"
#include "core/motion/pose_history.hpp"
#include "core/motion/range_objects.hpp"

namespace pilothouse {

/// Brings what all sensors saw to one instant, in robot coordinates.
class ObjectMerger {
 public:
  struct Ranger {
    std::string name;
    Eigen::Isometry3d T_base_ranger;
  };
  /// Source 0 is the camera, then the rangers in their order.
  ObjectMerger(const AvoidanceParameters& parameters, const Footprint& footprint,
               const std::vector<Ranger>& rangers);
  void setParameters(const AvoidanceParameters& parameters);

  /// @return false when refused (see PoseHistory).
  bool odometry(double stamp, const Pose2& pose, const Twist2& twist);
  /// @return false when the pose at its stamp is not known (yet).
  bool floor(const FloorFrame& frame);
  /// @param ranger index into the constructor's list. @return false for a reading that means
  /// nothing.
  bool range(std::size_t ranger, double stamp, const RangeReading& reading);
  /// Everything at `now`, valid until the next call. Objects of a source that is older than a
  /// second are left out; the age of each is told.
  const Surroundings& merge(double now);
  const LocalMemory& memory() const { return memory_; }
  /// The base's pose at `now` in the odometry frame, where known.
  std::optional<Pose2> pose(double now) const { return poses_.at(now); }
  const PoseHistory& poses() const { return poses_; }
  /// Forgets everything, e.g. when time jumps.
  void clear();

 private:
  struct Seen {
    double stamp = -1.0;
    std::vector<Obstacle> objects;  ///< base frame at the stamp
  };
  AvoidanceParameters parameters_;
  std::vector<Ranger> rangers_;
  std::vector<Seen> seen_;  ///< one a ranger; what the camera saw stays in the memory
  double floor_stamp_ = -1.0;
  Pose2 driven_to_;  ///< where the memory last knew the robot
  PoseHistory poses_;
  LocalMemory memory_;
  Surroundings merged_;
};

}  // namespace pilothouse
