#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/local_memory.hpp"
#include "core/motion/range_objects.hpp"

namespace pilothouse {

/// The base's pose at a time, from odometry.
class PoseHistory {
 public:
  /// @return false when refused: not finite, or older than the newest (time ran back: call
  /// clear()).
  bool add(double stamp, const Pose2& pose, const Twist2& twist);
  /// Interpolated; beyond the newest by at most 0.3 s with its twist. Nothing where unknown.
  std::optional<Pose2> at(double stamp) const;
  std::optional<double> newest() const;
  Twist2 twist() const { return twist_; }
  void clear() { size_ = 0; }

 private:
  static constexpr std::size_t kKept = 256;
  struct Entry {
    double stamp;
    Pose2 pose;
  };
  std::array<Entry, kKept> entries_{};
  std::size_t next_ = 0, size_ = 0;
  Twist2 twist_;
};

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
  /// Other sources' objects, base frame at their stamp; `source` as added by addSource().
  std::size_t addSource(const std::string& name);
  bool objects(std::size_t source, double stamp, const std::vector<Obstacle>& objects);

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
  std::vector<Seen> seen_;  ///< one a source; the camera's stay in the memory
  PoseHistory poses_;
  LocalMemory memory_;
  Surroundings merged_;
};

}  // namespace pilothouse
