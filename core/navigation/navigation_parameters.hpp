#pragma once

#include <string>
#include <vector>

namespace pilothouse {

/// How a goal is driven to.
struct NavigationParameters {
  double position_tolerance = 0.05;  ///< at the goal [m], 0.01..2
  double heading_tolerance = 0.05;   ///< at the goal, where a heading is wanted [rad], 0.01..3.2
  double patience = 4.0;    ///< held or not getting on for so long it does something [s], 0.5..600
  double look_angle = 0.8;  ///< looking round it turns so far to either side [rad], 0..3.1
  double back_distance = 0.5;   ///< and backs off so far [m], 0..3
  int tries = 3;                ///< of looking round and backing off before it gives up, 1..100
  double trust_distance = 1.5;  ///< what is seen farther off and not in the map leads the way round
                                ///< it, but keeps nobody from a goal [m], 0.5..20
  double replan_period = 2.0;   ///< a shorter way is sought so often [s], 0.2..600
  double pass_distance = 0.3;   ///< a route's point without heading and pause counts as passed so
                                ///< near [m], 0.02..2
  double cruise = 0.35;         ///< speed that times are foretold with at first [m/s], 0.02..10
};

/// Calls visit(key, value, low, high) for every number of the parameters; `tries` is an int.
template <class Parameters, class Visit>
void forEachNavigationParameter(Parameters& p, Visit visit) {
  visit("position_tolerance", p.position_tolerance, 0.01, 2.0);
  visit("heading_tolerance", p.heading_tolerance, 0.01, 3.2);
  visit("patience", p.patience, 0.5, 600.0);
  visit("look_angle", p.look_angle, 0.0, 3.1);
  visit("back_distance", p.back_distance, 0.0, 3.0);
  visit("tries", p.tries, 1, 100);
  visit("trust_distance", p.trust_distance, 0.5, 20.0);
  visit("replan_period", p.replan_period, 0.2, 600.0);
  visit("pass_distance", p.pass_distance, 0.02, 2.0);
  visit("cruise", p.cruise, 0.02, 10.0);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const NavigationParameters& parameters);

}  // namespace pilothouse
