#pragma once

#include <functional>

#include "core/motion/footprint.hpp"
#include "gui/model/place_state.hpp"
#include "gui/view/map_tool.hpp"

namespace pilothouse::gui {

/// How the view asks for something about the place.
using AskPlace = std::function<void(const std::function<void(PlaceAsks&)>&)>;

/// Aims at a goal, with its way before it is sent; or at where the robot is, to set its pose. What
/// is sent was in sight for a moment as it is: a key that repeats or a double click sends nothing.
class AimTool : public MapTool {
 public:
  enum class For { kGoal, kPose };
  static constexpr double kLook = 0.5;  ///< [s]
  AimTool(For what, const PlaceState& state, AskPlace ask, Footprint outline);

  void press(Eigen::Vector2d at, double reach) override;
  void drag(Eigen::Vector2d at, double reach) override;
  void release() override;
  void nudge(Eigen::Vector2d by) override;
  void key(ToolKey key) override;
  void paint(QPainter& painter, const MapView& view) override;
  AimWords words() override;
  bool refresh(double now) override;
  void begin(Eigen::Vector2d at) override;
  void end() override;

  const GoalAim& aim() const { return aim_; }
  const PoseSpread& spread() const { return spread_; }

 private:
  void enter();
  void send();
  void spreadBy(double factor);

  For for_;
  const PlaceState& state_;
  AskPlace ask_;
  Footprint outline_;
  double now_ = 0.0;
  GoalAim aim_;
  PoseSpread spread_;
  Eigen::Vector2d cross_ = Eigen::Vector2d::Zero();
  bool sends_on_release_ = false;  ///< pressed on the ghost and not dragged
  std::shared_ptr<const Preview> heard_;
  AimPhase shown_ = AimPhase::kNone;
  std::uint32_t seen_ = 0;    ///< version of the goal that is in sight with its way
  double seen_since_ = 1e18;  ///< steady [s]
};

}  // namespace pilothouse::gui
