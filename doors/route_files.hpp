#pragma once

#include <pilothouse/GoalRoute.h>

#include <string>
#include <vector>

#include "core/cloud/checked.hpp"

namespace pilothouse {

// Routes as YAML in a folder, NAME.yaml each:
//   frame: map
//   loop: false
//   points:
//     - {x: 1.0, y: 2.0, heading: 1.57, pause: 3.0}   # heading and pause only where there are any

/// Why this is no name for a route: letters, digits, _ and -, at most 64; empty: it is one.
std::string routeNameFault(const std::string& name);

/// @throws std::runtime_error with the reason; then what was there before is whole.
void saveRoute(const std::string& folder, const std::string& name, const GoalRoute& route);

/// Every key known, every number finite and in range. The reason begins with the file's name.
Checked<GoalRoute> loadRoute(const std::string& folder, const std::string& name);

/// Names of all routes in the folder, sorted; none where there is no such folder.
std::vector<std::string> routesIn(const std::string& folder);

}  // namespace pilothouse
