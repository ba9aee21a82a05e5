#include "gui/model/drive_streams.hpp"

#include <rosgraph_msgs/Clock.h>

#include "doors/guarded_subscriber.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/conversions_drive.hpp"
#include "gui/model/master.hpp"

namespace pilothouse::gui {

namespace {

constexpr std::size_t kMostRangers = 16;
constexpr double kStands = 1e-4;  // m/s

}  // namespace

DriveStreams::DriveStreams(ros::NodeHandle& node, ConsoleState& state, Helm* helm)
    : node_(node), state_(state), helm_(helm) {
  listenTo<SpeedLimit, LimitReading>("speed_limit", state_.limit, limitFromMessage,
                                     [this](double now, const LimitReading& r) {
                                       state_.telemetry.limit(now, r);
                                       if (helm_ && r.limited > kStands) helm_->limiterMoves();
                                     });
  listenTo<StopState, StopReading>("stop_state", state_.gate, stopFromMessage,
                                   [this](double now, const StopReading& r) {
                                     state_.telemetry.stop(now, r);
                                     if (helm_) {
                                       helm_->gateSays(r.beat, r.phase == GatePhase::kStopped);
                                     }
                                   });
  listen<sensor_msgs::JointState>("joint_states", [this](const auto& message) {
    const auto wheels = wheelsFromMessage(message);
    if (!wheels) return wheels.reason();
    state_.telemetry.wheels(steadySeconds(), *wheels);
    return std::string();
  });
  listen<Contacts>("contacts", [this](const auto& message) {
    auto reading = *contactsFromMessage(message);
    reading.at = steadySeconds();
    state_.contacts.set(std::move(reading));
    return std::string();
  });
  listen<RouteState>("route_state", [this](const auto& message) {
    const auto checked = routeFromMessage(message);
    if (!checked) return checked.reason();
    auto reading = *checked;
    reading.at = steadySeconds();
    state_.route.set(std::move(reading));
    return std::string();
  });
  listenToWishes("teleop");
  listenToWishes("task");
}

DriveStreams::~DriveStreams() {
  state_.clock.set(-1);
}

// @param store takes a message and returns why it was refused; empty: it was not.
template <class Message, class Store>
void DriveStreams::listen(const std::string& topic, Store store) {
  const auto refused = [this, topic](const std::string& reason) { this->refused(topic, reason); };
  auto options = guardedOptions<Message>(
      topic, 50,
      [store, refused](const ros::MessageEvent<const Message>& event) {
        const std::string reason = store(*event.getConstMessage());
        if (!reason.empty()) refused(reason);
      },
      refused);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_[topic] = node_.subscribe(options);
}

template <class Message, class Reading, class Use>
void DriveStreams::listenTo(const std::string& topic, Feed<Reading>& feed,
                            Checked<Reading> (*convert)(const Message&), Use use) {
  const std::string name = node_.resolveName(topic);
  auto options = guardedOptions<Message>(
      topic, 50,
      [&feed, convert, use, name](const ros::MessageEvent<const Message>& event) {
        const auto message = event.getConstMessage();
        const double now = steadySeconds();
        feed.arrived(now, message->header.seq, event.getPublisherName(), name);
        const Checked<Reading> checked = convert(*message);
        if (!checked) {
          feed.reject(checked.reason(), now);
          return;
        }
        use(now, *checked);
        feed.deliver(
            Checked<std::shared_ptr<const Reading>>::of(std::make_shared<const Reading>(*checked)),
            now, 0.0);
      },
      [&feed](const std::string& reason) { feed.reject(reason, steadySeconds()); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_[topic] = node_.subscribe(options);
}

void DriveStreams::listenToRanger(const std::string& topic, const std::string& name) {
  listen<sensor_msgs::Range>(topic, [this, name](const auto& message) {
    const auto checked = rangeFromMessage(message);
    if (!checked) return checked.reason();
    auto reading = *checked;
    reading.name = name;
    reading.at = steadySeconds();
    state_.telemetry.range(reading.at, reading);
    state_.ranges.update([&](auto& all) { all[name] = reading; });
    return std::string();
  });
}

void DriveStreams::listenToWishes(const std::string& source) {
  listen<geometry_msgs::TwistStamped>("cmd_vel/" + source, [this, source](const auto& message) {
    const auto checked = wantedFromMessage(message);
    if (!checked) return checked.reason();
    auto reading = *checked;
    reading.at = steadySeconds();
    state_.wanted.update([&](auto& all) { all[source] = reading; });
    return std::string();
  });
}

void DriveStreams::review(const std::set<std::string>& advertised) {
  const std::string prefix = node_.resolveName("range") + "/";
  std::size_t rangers = 0;
  for (const auto& topic : advertised) {
    if (topic.compare(0, prefix.size(), prefix) != 0) continue;
    if (++rangers > kMostRangers) break;
    if (subscribers_.count(topic) == 0) listenToRanger(topic, topic.substr(prefix.size()));
  }
  const bool simulated = masterFlag("/use_sim_time");
  if (!simulated) {
    subscribers_.erase("/clock");
    state_.clock.set(-1);
  } else if (subscribers_.count("/clock") == 0) {
    listen<rosgraph_msgs::Clock>("/clock", [this](const auto& message) {
      state_.clock.set(static_cast<std::int64_t>(message.clock.toNSec()));
      return std::string();
    });
  }
}

void DriveStreams::refused(const std::string& topic, const std::string& reason) {
  state_.refusals.update([&](auto& all) { all[topic] = {plainText(reason), steadySeconds()}; });
}

}  // namespace pilothouse::gui
