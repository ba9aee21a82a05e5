// What the goal navigator does when it is stuck: plans anew, looks round, backs off, rests.
#include <cmath>

#include "core/navigation/goal_navigator.hpp"

namespace pilothouse {
namespace {

constexpr double kElsewhere = 0.5;     // stuck so far from the last time is another case [m]
constexpr double kLongestLook = 6.0;   // [s]
constexpr double kLongestBack = 12.0;  // [s]

}  // namespace

/// The next measure of the ladder: plan anew, look round, back off, rest; some times over.
void GoalNavigator::stuck(const NavigationInput& input) {
  const double off = (input.pose->position() - goal_.place).norm();
  if (off < stuck_off_ - kElsewhere) {
    tries_ = 0;
    measure_ = Measure::kReplan;
    stuck_off_ = off;
  }
  if (!text_.empty()) stuck_by_ = text_;
  got_on_ = turned_on_ = now_;
  if (measure_ == Measure::kReplan) {
    measure_ = Measure::kLook;
    // Nothing known is in the way: the same way would come out again.
    const bool same = !path_.empty() && planner_.free(judged(*input.pose));
    if (!same && (replan(input) || ended())) return;
  }
  if (measure_ == Measure::kLook) {
    measure_ = Measure::kBack;
    if (parameters_.look_angle > 0.0) return lookRound(input);
  }
  if (measure_ == Measure::kBack) {
    measure_ = Measure::kRest;
    if (backOff(input)) return;
  }
  measure_ = Measure::kReplan;
  if (++tries_ < parameters_.tries) {
    replan(input);
    return;
  }
  const Plan plan = seek(input).plan;
  const std::string tried = "gave up after " + std::to_string(tries_) + " tries: ";
  fail(tried + (plan ? stuck_by_ : textOf(plan.why)), plan.nearest);
}

/// To one side, to the other, and back; each a route of one point.
void GoalNavigator::lookRound(const NavigationInput& input) {
  looks_ = 0;
  look_from_ = *input.pose;
  lookTo(0);
}

void GoalNavigator::lookTo(int look) {
  const double turns[] = {parameters_.look_angle, -parameters_.look_angle, 0.0};
  looks_ = look;
  path_.clear();
  send({look_from_}, wrapped(look_from_.heading + turns[look]));
  enter(NavigationPhase::kLooking);
  text_ = "looks round: " + stuck_by_;
}

/// To where it came from.
bool GoalNavigator::backOff(const NavigationInput& input) {
  if (!(parameters_.back_distance > 0.0)) return false;
  for (auto place = trail_.rbegin(); place != trail_.rend(); ++place) {
    const double off = (place->position() - input.pose->position()).norm();
    if (off < parameters_.back_distance) continue;
    Plan plan = planner_.plan({*input.pose, place->position(), std::nullopt});
    if (!plan || plan.length > 4.0 * parameters_.back_distance) return false;
    path_.clear();
    send(std::move(plan.poses), std::nullopt);
    enter(NavigationPhase::kBacking);
    text_ = "backs off: " + stuck_by_;
    return true;
  }
  return false;
}

void GoalNavigator::manoeuvre(const NavigationInput& input) {
  if (input.halted) since_ = now_;
  const bool looking = phase_ == NavigationPhase::kLooking;
  const bool over = now_ - since_ > (looking ? kLongestLook : kLongestBack);
  if (!over && !isHeard(input, ExecutorReport::kReached)) return;
  if (looking && looks_ < 2) return lookTo(looks_ + 1);
  got_on_ = turned_on_ = now_;
  replan(input);
}

}  // namespace pilothouse
