#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>

#include "gui/model/console_state.hpp"
#include "gui/model/place_asks.hpp"

namespace pilothouse::gui {

class ErrandThread;

/// Runs what the operator asks about the place, on threads of their own: a planner that hangs
/// delays neither the window nor arming nor a goal, and a map that takes long to save no cancel.
/// Goals go out on move_base_simple/goal, poses on initialpose; the rest are services of the
/// navigator. What waited too long is not sent. Answers come into state.place.
class PlaceErrands : public PlaceAsks {
 public:
  /// On the link thread: advertising asks the master.
  explicit PlaceErrands(ConsoleState& state);
  /// An errand that hangs is left behind, and what it brings is thrown away.
  ~PlaceErrands() override;

  void preview(std::uint32_t id, const PlaceGoal& goal, const std::optional<Pose2>& from) override;
  void goTo(const PlaceGoal& goal) override;
  void setPose(const Pose2& pose, const PoseSpread& spread) override;
  void driveRoute(const RouteDraft& draft) override;
  void saveRoute(const RouteDraft& draft) override;
  void loadRoute(const std::string& name) override;
  void task(TaskCall call) override;
  void saveMap(const std::string& name) override;
  void loadMap(const std::string& name) override;
  void clearMap() override;

 private:
  struct Desk;
  /// In the order asked on this lane; told in words where it is not sent.
  void send(ErrandThread& lane, const std::string& what, const std::function<void(Desk&)>& errand);

  std::shared_ptr<Desk> desk_;
};

}  // namespace pilothouse::gui
