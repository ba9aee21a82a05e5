#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Path.h>
#include <pilothouse/GoalRoute.h>
#include <pilothouse/MapGrid.h>
#include <pilothouse/NavigationState.h>
#include <pilothouse/PlanPath.h>
#include <pilothouse/TaskState.h>

#include <memory>

#include "core/cloud/checked.hpp"
#include "gui/model/place_asks.hpp"
#include "gui/model/place_readings.hpp"

namespace pilothouse::gui {

// Messages about the place into readings, and back. Nothing in a message is trusted: what is out of
// range is refused with the reason.

constexpr std::size_t kMostMapCells = 36'000'000;  ///< 6,000 a side: 190 MB of pictures
constexpr std::size_t kMostPathPoints = 20'000;

Checked<std::shared_ptr<const MapPicture>> mapFromMessage(const MapGrid& grid);
/// The pictures of the cells, finest first.
std::vector<QImage> mapLevels(const MapCells& cells);
Checked<PoseReading> poseFromMessage(const geometry_msgs::PoseWithCovarianceStamped& pose);
Checked<NavigationReading> navigationFromMessage(const NavigationState& state);
Checked<TaskReading> taskFromMessage(const TaskState& state);
Checked<PathReading> pathFromMessage(const nav_msgs::Path& path);
/// @param id of the ask.
Checked<Preview> previewFromResponse(const PlanPath::Response& response, std::uint32_t id);
Checked<RouteDraft> routeFromResponse(const GoalRoute& route);

/// An orientation of zeros where any heading will do.
geometry_msgs::Pose toPose(const PlaceGoal& goal);
GoalRoute toMessage(const RouteDraft& draft, const std::string& frame);
/// @param spread standard deviations.
geometry_msgs::PoseWithCovarianceStamped toMessage(const Pose2& pose, const PoseSpread& spread);

}  // namespace pilothouse::gui
