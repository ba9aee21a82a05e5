#pragma once

#include <string>

#include "gui/model/console_state.hpp"
#include "gui/model/helm.hpp"

namespace pilothouse::gui {

/// What a person asked for by holding "arm": when (steady [s]) and which stops it takes back.
struct ArmWish {
  StopSerial stops = 0;
  double at = 0.0;
};

/// The stop gate's door for arming. Both may take as long as master and gate like, and say why they
/// failed; empty: they did not.
class ArmService {
 public:
  virtual ~ArmService() = default;
  /// Looks for the gate at the master.
  virtual std::string find() = 0;
  /// Asks the gate that was found, without the master.
  virtual std::string call() = 0;
};

constexpr double kArmWishHolds = 1.0;  ///< an older wish is nobody's wish any more [s]

/// Takes the stops of the wish back and arms the gate. Nothing is taken back and nothing armed when
/// the wish grew old on the way, when a stop was pressed since, or when the gate has not confirmed
/// that it holds the robot. @param helm may be null. @return why not; empty: armed.
std::string arm(ArmService& service, const ConsoleState& state, Helm* helm, const ArmWish& wish);

/// The same with the gate that the master names; for a thread that may wait.
std::string armTheGate(const ConsoleState& state, Helm* helm, const ArmWish& wish);

}  // namespace pilothouse::gui
