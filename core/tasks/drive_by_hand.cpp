#include "core/tasks/behaviour.hpp"

namespace pilothouse {
namespace {

constexpr double kLetGo = 1.0;  // so long after the last command the person has let go [s]

/// A person drives: whatever else there is stands aside until they let go.
class DriveByHand : public Behaviour {
 public:
  BehaviourReport step(const TaskInput& input) override {
    const double now = input.navigation.now;
    if (input.hand || !began_ || now < last_) last_ = now;
    began_ = true;
    BehaviourReport report;
    report.text = "driven by hand";
    if (now - last_ > kLetGo) report.state = BehaviourReport::kDone;
    return report;
  }

 private:
  bool began_ = false;
  double last_ = 0.0;
};

}  // namespace

const BehaviourKind kDriveByHand = {
    "hand", 100, false, [](const Wish&) { return std::string(); },
    [](const Wish&, const BehaviourTools&) -> std::unique_ptr<Behaviour> {
      return std::make_unique<DriveByHand>();
    }};

}  // namespace pilothouse
