#include "core/tasks/behaviour.hpp"

namespace pilothouse {

// A new behaviour is a file with its kind, declared in behaviour.hpp, and a line here.
const std::vector<BehaviourKind>& behaviourKinds() {
  static const std::vector<BehaviourKind> kinds = {
      kDriveByHand,
      kGoTo,
      kFollowRoute,
  };
  return kinds;
}

}  // namespace pilothouse
