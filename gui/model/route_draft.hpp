#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace pilothouse::gui {

/// A goal on the map [m]; no heading: any [rad].
struct PlaceGoal {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  std::optional<double> heading;
};

/// A point of a route that is being edited.
struct DraftPoint {
  PlaceGoal goal;
  double pause = 0.0;  ///< the robot stands there so long [s], 0..kMostPause

  bool operator==(const DraftPoint& other) const;
};

/// A route as the operator edits it, in the map's frame. A value: each step of editing makes a new
/// one, so that undoing is putting back the old.
struct RouteDraft {
  static constexpr std::size_t kMostPoints = 1000;
  static constexpr double kMostPause = 3600.0;

  std::string name;
  bool loop = false;
  std::vector<DraftPoint> points;

  bool operator==(const RouteDraft& other) const;
  bool empty() const { return points.empty(); }
  /// Straight from point to point, and back to the first in a loop [m]; the robot's way may be
  /// longer.
  double length() const;
};

// Steps of editing. What cannot be done returns the draft as it was.

/// @param before index of the point that will follow; points.size(): at the end.
RouteDraft withPoint(RouteDraft draft, std::size_t before, const DraftPoint& point);
RouteDraft withoutPoint(RouteDraft draft, std::size_t index);
RouteDraft withPlace(RouteDraft draft, std::size_t index, Eigen::Vector2d place);
/// @param heading none: any.
RouteDraft withHeading(RouteDraft draft, std::size_t index, std::optional<double> heading);
RouteDraft withPause(RouteDraft draft, std::size_t index, double seconds);
/// The point comes one earlier (by -1) or later (by +1). @param by anything else changes nothing.
RouteDraft withOrder(RouteDraft draft, std::size_t index, int by);
RouteDraft withLoop(RouteDraft draft, bool loop);
/// Where the point of this index is after a step: where it was, when it alone was changed; else
/// where its like is. None: it has gone.
std::optional<std::size_t> pointAfter(const RouteDraft& before, std::size_t index,
                                      const RouteDraft& after);

/// The point nearest to the place within `reach` [m].
std::optional<std::size_t> pointAt(const RouteDraft& draft, Eigen::Vector2d place, double reach);
/// Where a point at the place would have to go to lie on a leg that passes within `reach` [m]:
/// index of the point that follows; the leg back of a loop gives points.size().
std::optional<std::size_t> legAt(const RouteDraft& draft, Eigen::Vector2d place, double reach);

/// Why the route cannot be sent, in words; empty: it can.
std::string faultOf(const RouteDraft& draft);
/// Why this is no name to save under: letters, digits, _ and -, at most 64; empty: it is one.
std::string routeNameFault(const std::string& name);

}  // namespace pilothouse::gui
