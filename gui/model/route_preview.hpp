#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gui/model/place_asks.hpp"

namespace pilothouse::gui {

/// A leg of a route that is to be planned. @param from none: from where the robot is.
struct LegAsk {
  std::uint32_t id = 0;
  std::optional<Pose2> from;
  PlaceGoal to;
};

/// The ways along a route that is being edited, leg by leg: from the robot to the first point, from
/// point to point, and in a loop back to the first. Asked one at a time, once the route rests, and
/// again now and then, for the map and the robot change; a leg that was not touched keeps its way.
/// No time, no ROS of its own: steady seconds are arguments.
class RoutePreview {
 public:
  static constexpr std::size_t kMostLegs = 40;  ///< further ones stay straight
  static constexpr double kRest = 0.3;          ///< since the route last changed [s]
  static constexpr double kAskEvery = 0.15;     ///< [s]
  static constexpr double kAgain = 5.0;         ///< a way is that old when it is planned anew [s]
  static constexpr double kPatience = 3.0;      ///< with an answer; then the next is asked [s]

  /// The route as it is now.
  void follow(const RouteDraft& draft, double now);
  /// What to ask now; none: nothing is due.
  std::optional<LegAsk> due(double now);
  /// The newest answer, which may be somebody else's or old. @return it was to one of the legs.
  bool answered(const std::shared_ptr<const Preview>& preview);

  /// The answer for the leg to a point, from the one before it; for points.size() of a loop: back
  /// to the first. Null: none yet, or beyond kMostLegs.
  const Preview* legTo(std::size_t point) const;

  struct Sum {
    bool complete = false;               ///< every leg has its way
    double length = 0.0;                 ///< [m]
    double time = 0.0;                   ///< as the navigator foretells it, pauses included [s]
    std::optional<std::size_t> blocked;  ///< the first leg without a way, as for legTo()
  };
  Sum sum() const;

 private:
  static constexpr double kNever = -1e9;
  struct Leg {
    std::optional<Pose2> from;
    PlaceGoal to;
    std::shared_ptr<const Preview> answer;
    double planned_at = kNever;  ///< asked then, steady [s]
  };
  static std::vector<Leg> legsOf(const RouteDraft& draft);

  RouteDraft draft_;
  std::vector<Leg> legs_;
  double changed_at_ = -1e9, asked_at_ = -1e9;
  std::uint32_t asked_ = 0;               ///< id of the newest ask
  std::optional<std::size_t> under_way_;  ///< leg that is being planned
};

}  // namespace pilothouse::gui
