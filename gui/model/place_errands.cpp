#include "gui/model/place_errands.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <pilothouse/DriveRoute.h>
#include <pilothouse/LoadRoute.h>
#include <pilothouse/MapFile.h>
#include <pilothouse/SaveRoute.h>
#include <std_srvs/Trigger.h>

#include <atomic>

#include "doors/guarded_call.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/conversions_drive.hpp"
#include "gui/model/conversions_place.hpp"
#include "gui/model/errand_thread.hpp"

namespace pilothouse::gui {

namespace {

constexpr std::size_t kMostFiles = 1000;

const char* serviceOf(TaskCall call) {
  switch (call) {
    case TaskCall::kPause:
      return "task/pause";
    case TaskCall::kResume:
      return "task/resume";
    case TaskCall::kSkip:
      return "task/skip";
    case TaskCall::kCancel:
      break;
  }
  return "task/cancel";
}

const char* doneOf(TaskCall call) {
  switch (call) {
    case TaskCall::kPause:
      return "paused";
    case TaskCall::kResume:
      return "resumed";
    case TaskCall::kSkip:
      return "point skipped";
    case TaskCall::kCancel:
      break;
  }
  return "cancelled";
}

}  // namespace

/// Shared with the errands, which may outlive the one who gave them.
struct PlaceErrands::Desk {
  explicit Desk(ConsoleState& console)
      : state(console),
        goal(node.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 2)),
        pose(node.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 2)) {}

  std::string mapFrame() const {
    const auto map = state.place.map.latest();
    return map && !map->frame.empty() ? map->frame : "map";
  }
  ros::Time now() const {
    const std::int64_t simulated = state.clock.simulated();
    if (simulated >= 0) return ros::Time().fromNSec(static_cast<std::uint64_t>(simulated));
    const ros::WallTime wall = ros::WallTime::now();
    return {wall.sec, wall.nsec};
  }
  void answer(bool done, const std::string& text) {
    if (gone) return;
    state.place.answer.update([&](AskAnswer& newest) {
      newest = {newest.serial + 1, done, plainText(text), steadySeconds()};
    });
  }
  template <class Service>
  std::string call(const std::string& name, typename Service::Request& request,
                   typename Service::Response& response) {
    auto client = node.serviceClient<Service>(name);
    return callGuarded<Service>(client, request, response);
  }
  template <class Message>
  void publish(ros::Publisher& publisher, const Message& message, const std::string& done) {
    const bool heard = publisher.getNumSubscribers() > 0;
    publisher.publish(message);
    answer(heard, heard ? done : "nobody listens to " + publisher.getTopic());
  }
  /// Calls and tells how it went. @param done what to say where it succeeded; empty: what the
  /// service says.
  template <class Service>
  bool callAndTell(const std::string& name, typename Service::Request& request,
                   typename Service::Response& response, const std::string& done) {
    const std::string fault = call<Service>(name, request, response);
    const bool well = fault.empty() && response.success;
    answer(well, !fault.empty() ? fault : well && !done.empty() ? done : response.message);
    return well;
  }

  ConsoleState& state;
  std::atomic<bool> gone{false};
  ros::NodeHandle node;
  ros::Publisher goal, pose;
  std::unique_ptr<ErrandThread> thread;
};

PlaceErrands::PlaceErrands(ConsoleState& state) : desk_(std::make_shared<Desk>(state)) {
  const std::weak_ptr<Desk> weak = desk_;  // the desk holds the thread
  desk_->thread = std::make_unique<ErrandThread>([weak](const std::string& what) {
    const auto desk = weak.lock();
    if (desk && !desk->gone) desk->state.place.asking.set({what, steadySeconds()});
  });
}

PlaceErrands::~PlaceErrands() {
  desk_->gone = true;
  desk_->thread.reset();
  desk_->state.place.asking.set({});
}

void PlaceErrands::preview(std::uint32_t id, const PlaceGoal& goal,
                           const std::optional<Pose2>& from) {
  desk_->thread->addIdle("plan", [desk = desk_, id, goal, from] {
    PlanPath::Request request;
    PlanPath::Response response;
    request.goal.header.frame_id = desk->mapFrame();
    request.goal.header.stamp = desk->now();
    request.goal.pose = toPose(goal);
    if (from) {
      request.start.header = request.goal.header;
      request.start.pose = toPose({from->position(), from->heading});
    }
    Preview preview;
    preview.id = id;
    preview.why = desk->call<PlanPath>("plan_path", request, response);
    if (preview.why.empty()) {
      const auto checked = previewFromResponse(response, id);
      if (checked) preview = *checked;
      if (!checked) preview.why = plainText("plan_path: " + checked.reason());
    }
    if (!desk->gone) desk->state.place.preview.set(std::make_shared<const Preview>(preview));
  });
}

void PlaceErrands::goTo(const PlaceGoal& goal) {
  desk_->thread->add("goal", [desk = desk_, goal] {
    geometry_msgs::PoseStamped message;
    message.header.frame_id = desk->mapFrame();
    message.header.stamp = desk->now();
    message.pose = toPose(goal);
    desk->publish(desk->goal, message, "goal sent");
  });
}

void PlaceErrands::setPose(const Pose2& pose, const PoseSpread& spread) {
  desk_->thread->add("pose", [desk = desk_, pose, spread] {
    auto message = toMessage(pose, spread);
    message.header.frame_id = desk->mapFrame();
    message.header.stamp = desk->now();
    desk->publish(desk->pose, message, "pose sent");
  });
}

void PlaceErrands::driveRoute(const RouteDraft& draft) {
  desk_->thread->add("route", [desk = desk_, draft] {
    DriveRoute::Request request;
    DriveRoute::Response response;
    request.route = toMessage(draft, desk->mapFrame());
    desk->callAndTell<DriveRoute>("route/drive", request, response, "route sent");
  });
}

void PlaceErrands::saveRoute(const RouteDraft& draft) {
  desk_->thread->add("save", [desk = desk_, draft] {
    SaveRoute::Request request;
    SaveRoute::Response response;
    request.file = draft.name;
    request.route = toMessage(draft, desk->mapFrame());
    desk->callAndTell<SaveRoute>("route/save", request, response, "route saved as " + draft.name);
  });
}

void PlaceErrands::loadRoute(const std::string& name) {
  desk_->thread->add("load", [desk = desk_, name] {
    LoadRoute::Request request;
    LoadRoute::Response response;
    request.file = name;
    const std::string fault = desk->call<LoadRoute>("route/load", request, response);
    if (!fault.empty()) return desk->answer(false, fault);
    if (!response.success) return desk->answer(false, response.message);
    RouteShelf shelf;
    if (!name.empty()) {
      const auto route = routeFromResponse(response.route);
      if (!route) return desk->answer(false, "route/load: " + route.reason());
      if (response.route.header.frame_id != desk->mapFrame() &&
          !response.route.header.frame_id.empty()) {
        return desk->answer(false, "the route is in frame " + response.route.header.frame_id +
                                       ", expected " + desk->mapFrame());
      }
      shelf.route = *route;
      shelf.route->name = name;
    }
    for (const auto& file : response.files) {
      if (shelf.files.size() < kMostFiles) shelf.files.push_back(plainText(file, 64));
    }
    if (desk->gone) return;
    desk->state.place.shelf.update([&](std::shared_ptr<const RouteShelf>& newest) {
      shelf.serial = newest ? newest->serial + 1 : 1;
      newest = std::make_shared<const RouteShelf>(shelf);
    });
    if (!name.empty()) desk->answer(true, "route " + name + " loaded");
  });
}

void PlaceErrands::task(TaskCall call) {
  desk_->thread->add("task", [desk = desk_, call] {
    std_srvs::Trigger::Request request;
    std_srvs::Trigger::Response response;
    desk->callAndTell<std_srvs::Trigger>(serviceOf(call), request, response, doneOf(call));
  });
}

void PlaceErrands::saveMap(const std::string& name) {
  desk_->thread->add("save the map", [desk = desk_, name] {
    MapFile::Request request;
    MapFile::Response response;
    request.name = name;
    desk->callAndTell<MapFile>("map/save", request, response, "");
  });
}

void PlaceErrands::loadMap(const std::string& name) {
  desk_->thread->add("load a map", [desk = desk_, name] {
    MapFile::Request request;
    MapFile::Response response;
    request.name = name;
    desk->callAndTell<MapFile>("map/load", request, response, "");
  });
}

void PlaceErrands::clearMap() {
  desk_->thread->add("clear the map", [desk = desk_] {
    std_srvs::Trigger::Request request;
    std_srvs::Trigger::Response response;
    desk->callAndTell<std_srvs::Trigger>("map/clear", request, response, "");
  });
}

}  // namespace pilothouse::gui
