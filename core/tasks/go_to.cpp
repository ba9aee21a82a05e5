#include "core/tasks/behaviour.hpp"
#include "core/tasks/route_faults.hpp"

namespace pilothouse {
namespace {

/// To one goal.
class GoTo : public Behaviour {
 public:
  GoTo(const Goal& goal, const BehaviourTools& tools)
      : navigator_(tools.navigation, tools.planner) {
    navigator_.start(goal);
  }
  void resume() override { navigator_.resume(); }
  BehaviourReport step(const TaskInput& input) override {
    const NavigationOutput output = navigator_.step(input.navigation);
    BehaviourReport report;
    report.navigation = output.status;
    report.order = output.order;
    report.text = output.status.text;
    report.points = 1;
    if (output.status.phase == NavigationPhase::kReached) report.state = BehaviourReport::kDone;
    if (output.status.phase == NavigationPhase::kFailed) report.state = BehaviourReport::kFailed;
    return report;
  }

 private:
  GoalNavigator navigator_;
};

}  // namespace

const BehaviourKind kGoTo = {
    "go_to", 50, true,
    [](const Wish& wish) {
      if (wish.stops.size() != 1) {
        return std::to_string(wish.stops.size()) + " goals, expected one";
      }
      return faultOfStops(wish);
    },
    [](const Wish& wish, const BehaviourTools& tools) -> std::unique_ptr<Behaviour> {
      return std::make_unique<GoTo>(wish.stops.front().goal, tools);
    }};

}  // namespace pilothouse
