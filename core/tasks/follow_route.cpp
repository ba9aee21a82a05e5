#include <algorithm>
#include <cstdio>

#include "core/tasks/behaviour.hpp"
#include "core/tasks/route_faults.hpp"

namespace pilothouse {
namespace {

constexpr double kAside = 0.05;         // the base may drive so far beside its way [m]
constexpr std::size_t kMostAhead = 16;  // points that may be planned to beyond the next

/// To one stop after the other.
class FollowRoute : public Behaviour {
 public:
  FollowRoute(const Wish& wish, const BehaviourTools& tools)
      : stops_(wish.stops),
        loop_(wish.loop),
        pass_distance_(tools.navigation.pass_distance),
        joins_(pass_distance_ > tools.planner.parameters().corners.max_cut + kAside),
        navigator_(tools.navigation, tools.planner) {
    navigator_.start(stops_.front().goal, beyond());
  }
  void resume() override { navigator_.resume(); }
  std::string skip() override {
    if (!advance()) return "this is the last point";
    return {};
  }

  BehaviourReport step(const TaskInput& input) override {
    const double now = input.navigation.now;
    if (now < last_ && pausing_) until_ = now + stops_[at_].pause;  // time was set back
    last_ = now;
    BehaviourReport report;
    if (!pausing_) {
      const NavigationOutput output = navigator_.step(input.navigation);
      status_ = output.status;
      report.order = output.order;
      if (status_.phase == NavigationPhase::kFailed) report.state = BehaviourReport::kFailed;
      if (passes(input)) {
        at_ = next(at_);
        navigator_.goOn(stops_[at_].goal, beyond());
      } else if (status_.phase == NavigationPhase::kReached) {
        arrive(now);
      }
    }
    if (pausing_) wait(now, report);
    report.navigation = status_;
    report.points = stops_.size();
    report.point = at_;
    report.text = textOf(status_.text);
    addRest(report.navigation);
    return report;
  }

 private:
  std::size_t next(std::size_t at) const { return (at + 1) % stops_.size(); }
  bool isLast() const { return at_ + 1 == stops_.size() && !loop_; }
  bool advance() {
    if (isLast()) return false;
    at_ = next(at_);
    pausing_ = false;
    navigator_.start(stops_[at_].goal, beyond());
    return true;
  }
  /// Whether the robot need not stand there.
  bool isThrough(std::size_t at) const {
    const RouteStop& stop = stops_[at];
    const bool last = at + 1 == stops_.size() && !loop_;
    return !stop.goal.heading && stop.pause == 0.0 && !last && stops_.size() > 1;
  }
  /// What it drives on to beyond the next point, up to the first at which it stands.
  std::vector<Goal> beyond() const {
    std::vector<Goal> goals;
    for (std::size_t at = at_; joins_ && isThrough(at) && goals.size() < kMostAhead;) {
      at = next(at);
      goals.push_back(stops_[at].goal);
    }
    return goals;
  }
  /// Near enough to a point at which it need not stand.
  bool passes(const TaskInput& input) const {
    const auto& pose = input.navigation.pose;
    if (!isThrough(at_) || status_.phase != NavigationPhase::kDriving || !pose) return false;
    return navigator_.isPast() ||
           (pose->position() - stops_[at_].goal.place).norm() < pass_distance_;
  }
  void arrive(double now) {
    pausing_ = true;
    until_ = now + stops_[at_].pause;
  }
  void wait(double now, BehaviourReport& report) {
    status_.phase = NavigationPhase::kPausing;
    char text[32];
    std::snprintf(text, sizeof text, "%.0f s to stand here", std::max(0.0, until_ - now));
    status_.text = text;
    if (now < until_) return;
    pausing_ = false;
    if (advance()) {
      status_.text.clear();
      status_.phase = NavigationPhase::kPlanning;
      return;
    }
    status_.phase = NavigationPhase::kReached;
    status_.text.clear();
    report.state = BehaviourReport::kDone;
  }
  std::string textOf(const std::string& text) const {
    return "point " + std::to_string(at_ + 1) + " of " + std::to_string(stops_.size()) +
           (text.empty() ? "" : ": " + text);
  }
  /// What lies behind the next point, as the crow flies.
  void addRest(NavigationStatus& status) const {
    if (!status.distance_left) return;
    double rest = 0.0, pauses = pausing_ ? 0.0 : stops_[at_].pause;
    for (std::size_t i = at_ + 1; i < stops_.size(); ++i) {
      rest += (stops_[i].goal.place - stops_[i - 1].goal.place).norm();
      pauses += stops_[i].pause;
    }
    if (*status.distance_left > 0.1 && status.time_left) {
      *status.time_left *= (*status.distance_left + rest) / *status.distance_left;
      *status.time_left += pauses;
    } else {
      status.time_left.reset();
    }
    *status.distance_left += rest;
  }

  std::vector<RouteStop> stops_;
  bool loop_;
  double pass_distance_;
  bool joins_;  ///< a rounded corner passes its point near enough
  GoalNavigator navigator_;
  NavigationStatus status_;
  std::size_t at_ = 0;
  bool pausing_ = false;
  double until_ = 0.0, last_ = 0.0;  ///< [s]
};

}  // namespace

const BehaviourKind kFollowRoute = {
    "route", 50, true, faultOfStops,
    [](const Wish& wish, const BehaviourTools& tools) -> std::unique_ptr<Behaviour> {
      return std::make_unique<FollowRoute>(wish, tools);
    }};

}  // namespace pilothouse
