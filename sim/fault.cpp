#include "sim/fault.hpp"

namespace pilothouse::sim {

std::optional<FaultKind> faultKind(const std::string& name) {
  if (name == "none") return FaultKind::kNone;
  if (name == "freeze") return FaultKind::kFreeze;
  if (name == "stand") return FaultKind::kStand;
  if (name == "drop") return FaultKind::kDrop;
  if (name == "delay") return FaultKind::kDelay;
  if (name == "corrupt") return FaultKind::kCorrupt;
  return std::nullopt;
}

}  // namespace pilothouse::sim
