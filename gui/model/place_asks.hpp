#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/planar.hpp"
#include "gui/model/place_readings.hpp"
#include "gui/model/route_draft.hpp"

namespace pilothouse::gui {

/// What the robot would do if this were its goal.
struct Preview {
  std::uint32_t id = 0;   ///< of the ask
  bool answered = false;  ///< false: nobody plans there; why says so
  bool found = false;
  std::string why;  ///< why there is no way
  PathReading path;
  double time = 0.0;                       ///< for it, as the navigator foretells it [s]
  std::optional<Eigen::Vector2d> nearest;  ///< the nearest place that can be reached
};

/// How sure a pose set by hand is: standard deviations.
struct PoseSpread {
  double place = 0.3;     ///< of x and of y [m]
  double heading = 0.17;  ///< [rad]
};

enum class TaskCall { kPause, kResume, kCancel, kSkip };

/// What became of the newest ask that the operator should hear of.
struct AskAnswer {
  std::uint32_t serial = 0;  ///< another one with each answer; 0: there was none yet
  bool done = false;
  std::string text;  ///< a sentence: what was done, or why not
  double at = -1e9;  ///< steady [s]
};

/// A route that was read for the operator, and all that there are.
struct RouteShelf {
  std::uint32_t serial = 0;         ///< another one with each answer
  std::optional<RouteDraft> route;  ///< none: only the list was wanted
  std::vector<std::string> files;
};

/// What the operator asks of the robot about the place. Every call returns at once, from the GUI
/// thread; answers come into PlaceState.
class PlaceAsks {
 public:
  virtual ~PlaceAsks() = default;
  /// Of several the newest counts. @param id of the caller's, comes back with the answer.
  /// @param from none: from where the robot is.
  virtual void preview(std::uint32_t id, const PlaceGoal& goal,
                       const std::optional<Pose2>& from) = 0;
  virtual void goTo(const PlaceGoal& goal) = 0;
  virtual void setPose(const Pose2& pose, const PoseSpread& spread) = 0;
  virtual void driveRoute(const RouteDraft& draft) = 0;
  virtual void saveRoute(const RouteDraft& draft) = 0;
  /// @param name empty: only the list is wanted.
  virtual void loadRoute(const std::string& name) = 0;
  virtual void task(TaskCall call) = 0;
  /// The map itself, in the robot's folder of maps.
  virtual void saveMap(const std::string& name) = 0;
  virtual void loadMap(const std::string& name) = 0;
  virtual void clearMap() = 0;
};

}  // namespace pilothouse::gui
