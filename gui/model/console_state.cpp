#include "gui/model/console_state.hpp"

#include "gui/model/drive_words.hpp"

namespace pilothouse::gui {

std::string shownTopic(const ConsoleState& state, const std::string& relative) {
  const auto names = state.names.get();
  const auto found = names.find(relative);
  const std::string name = found == names.end() ? relative : found->second;
  // The root namespace is the usual one: its slash says nothing to the operator.
  return name == "/" + relative ? relative : name;
}

namespace {

constexpr double kRefusalShown = 5.0;  // s
constexpr double kReadingShown = 2.0;  // s
constexpr double kAnswerShown = 8.0;   // s

void addDriving(const ConsoleState& state, double now, Situation& situation) {
  for (const auto& [topic, refusal] : state.refusals.get()) {
    if (now - refusal.at < kRefusalShown) {
      situation.complaints.push_back({topic + " rejected", refusal.reason, true});
    }
  }
  const ContactsReading contacts = state.contacts.get();
  if (contacts.count > 0 && now - contacts.at < kReadingShown) {
    situation.complaints.push_back(
        {"contacts", std::to_string(contacts.count) + " since the start", false});
  }
  const RouteReading route = state.route.get();
  // Where there are tasks their bar tells it, by the task's own points.
  const bool tasks = state.place.task.state(now).ever;
  if (!tasks && now - route.at < kReadingShown) situation.route = routeWords(route);
}

}  // namespace

Situation situationOf(const ConsoleState& state, const std::string& robot, double now) {
  Situation situation;
  situation.now = now;
  situation.link = linkAt(state.link.get(), now);
  situation.complaints = state.complaints.get();
  const std::string fault = state.floor_settings.get().fault;
  if (!fault.empty()) situation.complaints.push_back({"floor parameters", fault, false});
  situation.robot = robot;
  const auto advertised = state.advertised.get();
  const auto names = state.names.get();
  const auto anyOf = [&](std::initializer_list<const char*> topics) {
    for (const char* topic : topics) {
      const auto name = names.find(topic);
      if (name != names.end() && advertised.count(name->second) > 0) return true;
    }
    return false;
  };
  const auto add = [&](const char* what, const char* topic, bool there, bool essential,
                       const FeedState& feed) {
    situation.streams.push_back({what, shownTopic(state, topic), there, essential, feed});
    auto& named = situation.streams.back().state.topic;
    if (!named.empty() && named.find('/', 1) != std::string::npos) {
      for (const auto& [relative, resolved] : names) {
        if (named == resolved) named = shownTopic(state, relative);
      }
    }
  };
  add("depth", "camera/depth/image_rect", anyOf({"camera/depth/image_rect", "camera/depth/points"}),
      true, state.depth.state(now));
  add("floor grid", "floor_grid", anyOf({"floor_grid"}), true, state.floor.state(now));
  const auto depth = state.depth.latest();
  const FeedState depth_state = state.depth.state(now);
  const auto image = names.find("camera/depth/image_rect");
  situation.depth_without_info =
      depth && !depth->intrinsics && image != names.end() && depth_state.topic == image->second;
  situation.info_topic = shownTopic(state, "camera/depth/camera_info");
  // A floor that is judged all the same needs no transform: its nodelet searches the plane.
  if (freshness(state.floor.state(now)) > Freshness::kLate ||
      freshness(state.floor.state(now)) == Freshness::kNever) {
    situation.missing_transform = state.missing_transform.get();
  }
  add("colour", "camera/rgb/image_rect_color",
      anyOf({"camera/rgb/image_rect_color", "camera/rgb/image_rect_color/compressed",
             "camera/depth/points"}),
      false, state.colour.state(now));
  add("objects", "objects/camera", anyOf({"objects/filtered", "objects/merged", "objects/camera"}),
      false, state.objects.state(now));
  // Only where something can drive: a camera alone, or a bag, is complete without.
  if (anyOf({"odom", "speed_limit", "stop_state"}) || state.gate.state(now).ever) {
    add("stop gate", "stop_state", anyOf({"stop_state"}), true, state.gate.state(now));
    add("speed limiter", "speed_limit", anyOf({"speed_limit"}), true, state.limit.state(now));
    if (!anyOf({"odom"})) {
      situation.complaints.push_back(
          {"base", "nobody publishes " + shownTopic(state, "odom") + ": is it or its simulator on?",
           false});
    }
  }
  addDriving(state, now, situation);
  const AskAnswer answer = state.place.answer.get();
  if (now - answer.at < kAnswerShown) situation.answer = answer;
  return situation;
}

}  // namespace pilothouse::gui
