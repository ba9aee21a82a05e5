#pragma once

#include <string>
#include <vector>

namespace pilothouse {

/// How far odometry is trusted, and which matches of scans are.
struct TrackerParameters {
  double way_error = 0.02;       ///< along the way, spread after 1 m [m/sqrt(m)]
  double side_error = 0.01;      ///< across it [m/sqrt(m)]
  double way_turn_error = 0.02;  ///< of the heading, by driving [rad/sqrt(m)]
  double turn_error = 0.05;      ///< by turning [rad/sqrt(rad)]
  double gyro_error = 0.005;     ///< of the gyroscope's angle [rad/sqrt(s)]
  double gate = 16.3;    ///< squared Mahalanobis distance of a match; 16.3: 1 right in 1,000 lost
  double max_rms = 0.1;  ///< of a match's distances from the map [m]
  double min_overlap = 0.4;  ///< share of a scan's points that must be found in the map
  double max_spread = 0.5;   ///< a match that leaves more than this open tells nothing [m, rad]
  double widen_after = 2.0;  ///< matches that agree for so long against odometry are right [s]
};

/// Calls visit(key, value, low, high) for every number.
template <class Parameters, class Visit>
void forEachTrackerParameter(Parameters& p, Visit visit) {
  visit("way_error", p.way_error, 0.001, 1.0);
  visit("side_error", p.side_error, 0.001, 1.0);
  visit("way_turn_error", p.way_turn_error, 0.001, 1.0);
  visit("turn_error", p.turn_error, 0.001, 1.0);
  visit("gyro_error", p.gyro_error, 0.0001, 1.0);
  visit("gate", p.gate, 1.0, 1000.0);
  visit("max_rms", p.max_rms, 0.005, 1.0);
  visit("min_overlap", p.min_overlap, 0.05, 1.0);
  visit("max_spread", p.max_spread, 0.01, 100.0);
  visit("widen_after", p.widen_after, 0.2, 60.0);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const TrackerParameters& parameters);

}  // namespace pilothouse
