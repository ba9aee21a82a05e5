#include "gui/model/place_streams.hpp"

#include <cmath>

#include "doors/guarded_subscriber.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/conversions_drive.hpp"
#include "gui/model/conversions_place.hpp"

namespace pilothouse::gui {

namespace {
constexpr double kLookUp = 0.05;  // s between questions to tf
constexpr double kSilent = 0.5;   // s without `pose` until tf is asked
}  // namespace

PlaceStreams::PlaceStreams(ros::NodeHandle& node, ConsoleState& state,
                           ConversionThread& conversions, const tf2_ros::Buffer& transforms)
    : node_(node), state_(state), conversions_(conversions), transforms_(transforms) {
  listenToMap();
  listenToPicture("static_objects", conversions_.standing, state_.place.standing);
  listenTo<geometry_msgs::PoseWithCovarianceStamped, PoseReading>("pose", state_.place.pose,
                                                                  poseFromMessage);
  listenTo<NavigationState, NavigationReading>("navigation_state", state_.place.navigation,
                                               navigationFromMessage);
  listenTo<TaskState, TaskReading>("task_state", state_.place.task, taskFromMessage);
  listenToPath();
  timer_ = node_.createWallTimer(ros::WallDuration(kLookUp),
                                 [this](const ros::WallTimerEvent&) { lookUpPose(); });
}

PlaceStreams::~PlaceStreams() {
  state_.place.path.set(nullptr);
}

template <class Message, class Picture>
void PlaceStreams::listenToPicture(const std::string& topic, Mailbox<Message>& box,
                                   Feed<Picture>& feed) {
  const std::string name = node_.resolveName(topic);
  auto options = guardedOptions<Message>(
      topic, 2,
      [this, &box, &feed, name](const ros::MessageEvent<const Message>& event) {
        const auto message = event.getConstMessage();
        const double now = steadySeconds();
        feed.arrived(now, message->header.seq, event.getPublisherName(), name);
        if (box.put({message, now, 0.0, name})) feed.overwritten();
        conversions_.wake();
      },
      [&feed](const std::string& reason) { feed.reject(reason, steadySeconds()); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_[topic] = node_.subscribe(options);
}

template <class Message, class Reading>
void PlaceStreams::listenTo(const std::string& topic, Feed<Reading>& feed,
                            Checked<Reading> (*convert)(const Message&)) {
  const std::string name = node_.resolveName(topic);
  auto options = guardedOptions<Message>(
      topic, 10,
      [&feed, convert, name](const ros::MessageEvent<const Message>& event) {
        const auto message = event.getConstMessage();
        const double now = steadySeconds();
        feed.arrived(now, message->header.seq, event.getPublisherName(), name);
        const Checked<Reading> checked = convert(*message);
        if (!checked) return feed.reject(checked.reason(), now);
        auto reading = std::make_shared<Reading>(*checked);
        if constexpr (std::is_same_v<Reading, PoseReading>) reading->at = now;
        feed.deliver(Checked<std::shared_ptr<const Reading>>::of(std::move(reading)), now, 0.0);
      },
      [&feed](const std::string& reason) { feed.reject(reason, steadySeconds()); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_[topic] = node_.subscribe(options);
}

void PlaceStreams::listenToMap() {
  const std::string name = node_.resolveName("map_cells");
  // The painter may be at its work still when this connection has gone: it holds what it needs.
  const auto paint = [maps = maps_, &feed = state_.place.map] {
    const Arrival<MapGrid> arrival = maps->take();
    if (!arrival.message) return;
    try {
      feed.deliver(mapFromMessage(*arrival.message), arrival.at, 0.0);
    } catch (const std::exception& error) {  // out of memory: the map before stays
      feed.reject(error.what(), arrival.at);
    }
  };
  auto options = guardedOptions<MapGrid>(
      "map_cells", 2,
      [this, name, paint](const ros::MessageEvent<const MapGrid>& event) {
        const auto message = event.getConstMessage();
        const double now = steadySeconds();
        state_.place.map.arrived(now, message->header.seq, event.getPublisherName(), name);
        if (maps_->put({message, now, 0.0, name})) state_.place.map.overwritten();
        map_painter_.addIdle("map", paint);
      },
      [this](const std::string& reason) { state_.place.map.reject(reason, steadySeconds()); });
  subscribers_["map_cells"] = node_.subscribe(options);
}

void PlaceStreams::listenToPath() {
  const auto refused = [this](const std::string& reason) {
    state_.refusals.update([&](auto& all) { all["path"] = {plainText(reason), steadySeconds()}; });
  };
  auto options = guardedOptions<nav_msgs::Path>(
      "path", 2,
      [this, refused](const ros::MessageEvent<const nav_msgs::Path>& event) {
        const auto path = pathFromMessage(*event.getConstMessage());
        if (!path) return refused(path.reason());
        state_.place.path.set(std::make_shared<const PathReading>(*path));
      },
      refused);
  subscribers_["path"] = node_.subscribe(options);
}

void PlaceStreams::lookUpPose() {
  const double now = steadySeconds();
  const std::string topic = node_.resolveName("pose");
  const FeedState pose = state_.place.pose.state(now);
  if (pose.ever && pose.topic == topic && pose.age_s < kSilent) return;
  const auto map = state_.place.map.latest();
  geometry_msgs::PoseWithCovarianceStamped message;
  try {
    const auto found = transforms_.lookupTransform(map && !map->frame.empty() ? map->frame : "map",
                                                   "base_link", ros::Time(0));
    if (found.header.stamp == looked_up_stamp_) return;  // nothing new: the pose ages
    looked_up_stamp_ = found.header.stamp;
    message.header = found.header;
    message.pose.pose.position.x = found.transform.translation.x;
    message.pose.pose.position.y = found.transform.translation.y;
    message.pose.pose.orientation = found.transform.rotation;
  } catch (const tf2::TransformException&) {
    return;  // the panel says that there is no pose
  }
  state_.place.pose.arrived(now, ++looked_up_, "tf", "tf");
  const auto checked = poseFromMessage(message);
  if (!checked) return state_.place.pose.reject(checked.reason(), now);
  auto reading = std::make_shared<PoseReading>(*checked);
  reading->at = now;
  state_.place.pose.deliver(Checked<std::shared_ptr<const PoseReading>>::of(std::move(reading)),
                            now, 0.0);
}

}  // namespace pilothouse::gui
