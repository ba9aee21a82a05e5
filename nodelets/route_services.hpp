#pragma once

#include <pilothouse/DriveRoute.h>
#include <pilothouse/LoadRoute.h>
#include <pilothouse/SaveRoute.h>

#include <string>

#include "doors/guarded_service.hpp"
#include "nodelets/navigation_loop.hpp"

namespace pilothouse {

/// route/drive, route/save, route/load, and plan_path: what a console asks for before it sends the
/// robot anywhere.
class RouteServices {
 public:
  RouteServices(ros::NodeHandle& handle, NavigationLoop& loop, std::string folder,
                const OnRefused& on_refused);

 private:
  bool drive(const GoalRoute& route, DriveRoute::Response& response);
  bool save(const SaveRoute::Request& request, SaveRoute::Response& response);
  bool load(const std::string& name, LoadRoute::Response& response);
  bool plan(const PlanPath::Request& request, PlanPath::Response& response);

  NavigationLoop& loop_;
  std::string folder_;
  ros::ServiceServer drive_, save_, load_, plan_;
};

}  // namespace pilothouse
