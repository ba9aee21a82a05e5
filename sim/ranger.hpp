#pragma once

#include <cstdint>
#include <vector>

#include "sim/random.hpp"
#include "sim/sim_robot.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

struct RangerNoise {
  double spread = 0.005;      ///< of a reading [m]
  double drop_out = 0.002;    ///< share of readings without an echo
  double grazing_deg = 30.0;  ///< a surface that is hit flatter than this sends no echo back [deg]
};

/// An ultrasonic ranger: the nearest echo within its cone, tried by rays. Waves that strike a
/// surface flatly go on, so that the floor gives no echo.
class Ranger {
 public:
  Ranger(const SimRanger& ranger, const RangerNoise& noise, std::uint64_t seed);
  /// @return distance of the nearest echo [m], within min_range..max_range; +infinity: none within
  /// max_range; -infinity: nearer than min_range (REP 117).
  double measure(const WorldScene& scene, const Eigen::Isometry3d& T_world_base);
  const SimRanger& ranger() const { return ranger_; }

 private:
  double nearestEcho(const WorldScene& scene, const Eigen::Isometry3d& T_world_ranger) const;

  SimRanger ranger_;
  RangerNoise noise_;
  Random random_;
  std::vector<Eigen::Vector3d> rays_;  ///< unit, ranger's frame
};

}  // namespace pilothouse::sim
