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
constexpr double kStale = 3.0;  // s; what could not be sent by then may no longer be wanted

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

/// Shared with the errands, which may outlive the one who gave them. Each lane is a thread: who
/// hangs in one delays no other.
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
  std::unique_ptr<ErrandThread> topics;  ///< what is only published
  std::unique_ptr<ErrandThread> tasks;
  std::unique_ptr<ErrandThread> files;  ///< routes and maps that are kept
  std::unique_ptr<ErrandThread> plans;
};

PlaceErrands::PlaceErrands(ConsoleState& state) : desk_(std::make_shared<Desk>(state)) {
  const auto lane = [weak = std::weak_ptr<Desk>(desk_)] {  // the desk holds the lanes
    return std::make_unique<ErrandThread>(
        [weak, before = std::string()](const std::string& what) mutable {
          const auto desk = weak.lock();
          if (!desk || desk->gone) return;
          desk->state.place.asking.update([&](std::map<std::string, double>& all) {
            all.erase(before);
            if (!what.empty()) all[what] = steadySeconds();
          });
          before = what;
        });
  };
  desk_->topics = lane();
  desk_->tasks = lane();
  desk_->files = lane();
  desk_->plans = std::make_unique<ErrandThread>([](const std::string&) {});  // the aim tells it
}

PlaceErrands::~PlaceErrands() {
  desk_->gone = true;
  for (auto* lane : {&desk_->topics, &desk_->tasks, &desk_->files, &desk_->plans}) lane->reset();
  desk_->state.place.asking.set({});
}

void PlaceErrands::send(ErrandThread& lane, const std::string& what,
                        const std::function<void(Desk&)>& errand) {
  const bool taken = lane.add(what, [desk = desk_, what, errand, asked = steadySeconds()] {
    if (steadySeconds() - asked < kStale) return errand(*desk);
    desk->answer(false, "\"" + what + "\" was not sent: what was asked before it took too long");
  });
  if (!taken) {
    desk_->answer(false, "\"" + what + "\" was not sent: too much waits for the robot already");
  }
}

void PlaceErrands::preview(std::uint32_t id, const PlaceGoal& goal,
                           const std::optional<Pose2>& from) {
  desk_->plans->addIdle("plan", [desk = desk_, id, goal, from] {
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
  send(*desk_->topics, "goal", [goal](Desk& desk) {
    geometry_msgs::PoseStamped message;
    message.header.frame_id = desk.mapFrame();
    message.header.stamp = desk.now();
    message.pose = toPose(goal);
    desk.publish(desk.goal, message, "goal sent");
  });
}

void PlaceErrands::setPose(const Pose2& pose, const PoseSpread& spread) {
  send(*desk_->topics, "pose", [pose, spread](Desk& desk) {
    auto message = toMessage(pose, spread);
    message.header.frame_id = desk.mapFrame();
    message.header.stamp = desk.now();
    desk.publish(desk.pose, message, "pose sent");
  });
}

void PlaceErrands::driveRoute(const RouteDraft& draft) {
  send(*desk_->tasks, "route", [draft](Desk& desk) {
    DriveRoute::Request request;
    DriveRoute::Response response;
    request.route = toMessage(draft, desk.mapFrame());
    desk.callAndTell<DriveRoute>("route/drive", request, response, "route sent");
  });
}

void PlaceErrands::saveRoute(const RouteDraft& draft) {
  send(*desk_->files, "save the route", [draft](Desk& desk) {
    SaveRoute::Request request;
    SaveRoute::Response response;
    request.file = draft.name;
    request.route = toMessage(draft, desk.mapFrame());
    desk.callAndTell<SaveRoute>("route/save", request, response, "route saved as " + draft.name);
  });
}

void PlaceErrands::loadRoute(const std::string& name) {
  send(*desk_->files, "load a route", [name](Desk& desk) {
    LoadRoute::Request request;
    LoadRoute::Response response;
    request.file = name;
    const std::string fault = desk.call<LoadRoute>("route/load", request, response);
    if (!fault.empty()) return desk.answer(false, fault);
    if (!response.success) return desk.answer(false, response.message);
    RouteShelf shelf;
    if (!name.empty()) {
      const auto route = routeFromResponse(response.route);
      if (!route) return desk.answer(false, "route/load: " + route.reason());
      if (response.route.header.frame_id != desk.mapFrame() &&
          !response.route.header.frame_id.empty()) {
        return desk.answer(false, "the route is in frame " + response.route.header.frame_id +
                                      ", expected " + desk.mapFrame());
      }
      shelf.route = *route;
      shelf.route->name = name;
    }
    for (const auto& file : response.files) {
      if (shelf.files.size() < kMostFiles) shelf.files.push_back(plainText(file, 64));
    }
    if (desk.gone) return;
    desk.state.place.shelf.update([&](std::shared_ptr<const RouteShelf>& newest) {
      shelf.serial = newest ? newest->serial + 1 : 1;
      newest = std::make_shared<const RouteShelf>(shelf);
    });
    if (!name.empty()) desk.answer(true, "route " + name + " loaded");
  });
}

void PlaceErrands::task(TaskCall call) {
  const auto errand = [call](Desk& desk) {
    std_srvs::Trigger::Request request;
    std_srvs::Trigger::Response response;
    desk.callAndTell<std_srvs::Trigger>(serviceOf(call), request, response, doneOf(call));
  };
  if (call != TaskCall::kCancel) return send(*desk_->tasks, "task", errand);
  // Never too late, and nothing that waits may set out after it.
  desk_->topics->forget();
  desk_->tasks->forget();
  desk_->tasks->add("cancel", [desk = desk_, errand] { errand(*desk); });
}

void PlaceErrands::saveMap(const std::string& name) {
  send(*desk_->files, "save the map", [name](Desk& desk) {
    MapFile::Request request;
    MapFile::Response response;
    request.name = name;
    desk.callAndTell<MapFile>("map/save", request, response, "");
  });
}

void PlaceErrands::loadMap(const std::string& name) {
  send(*desk_->files, "load a map", [name](Desk& desk) {
    MapFile::Request request;
    MapFile::Response response;
    request.name = name;
    if (desk.callAndTell<MapFile>("map/load", request, response, "")) ++desk.state.place.place;
  });
}

void PlaceErrands::clearMap() {
  send(*desk_->files, "clear the map", [](Desk& desk) {
    std_srvs::Trigger::Request request;
    std_srvs::Trigger::Response response;
    desk.callAndTell<std_srvs::Trigger>("map/clear", request, response, "");
  });
}

}  // namespace pilothouse::gui
