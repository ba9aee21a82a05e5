#include "nodelets/route_services.hpp"

#include <utility>

#include "doors/route_files.hpp"

namespace pilothouse {

RouteServices::RouteServices(ros::NodeHandle& handle, NavigationLoop& loop, std::string folder,
                             const OnRefused& on_refused)
    : loop_(loop), folder_(std::move(folder)) {
  drive_ = advertiseGuarded<DriveRoute>(
      handle, "route/drive",
      [this](auto& request, auto& response) { return drive(request.route, response); }, on_refused);
  save_ = advertiseGuarded<SaveRoute>(
      handle, "route/save",
      [this](auto& request, auto& response) { return save(request, response); }, on_refused);
  load_ = advertiseGuarded<LoadRoute>(
      handle, "route/load",
      [this](auto& request, auto& response) { return load(request.file, response); }, on_refused);
  plan_ = advertiseGuarded<PlanPath>(
      handle, "plan_path",
      [this](auto& request, auto& response) { return plan(request, response); }, on_refused);
}

bool RouteServices::drive(const GoalRoute& route, DriveRoute::Response& response) {
  const auto task = loop_.follow(route);
  response.success = task ? 1 : 0;
  response.message = task.reason();
  return true;
}

bool RouteServices::save(const SaveRoute::Request& request, SaveRoute::Response& response) {
  try {
    saveRoute(folder_, request.file, request.route);
    response.success = 1;
  } catch (const std::runtime_error& fault) {
    response.message = fault.what();
  }
  return true;
}

bool RouteServices::load(const std::string& name, LoadRoute::Response& response) {
  try {
    response.files = routesIn(folder_);
  } catch (const std::runtime_error& fault) {
    response.message = fault.what();
    return true;
  }
  if (name.empty()) {
    response.success = 1;
    return true;
  }
  const auto route = loadRoute(folder_, name);
  response.success = route ? 1 : 0;
  response.message = route.reason();
  if (route) response.route = *route;
  return true;
}

bool RouteServices::plan(const PlanPath::Request& request, PlanPath::Response& response) {
  const Plan plan = loop_.plan(request.goal, request.start, response.message);
  response.found = plan ? 1 : 0;
  response.path = toPath(loop_.mapFrame(), plan.poses);
  response.length = static_cast<float>(plan.length);
  response.time = static_cast<float>(plan.length / loop_.cruise());
  response.has_nearest = plan.nearest ? 1 : 0;
  if (plan.nearest) {
    response.nearest.x = static_cast<float>(plan.nearest->x());
    response.nearest.y = static_cast<float>(plan.nearest->y());
  }
  return true;
}

}  // namespace pilothouse
