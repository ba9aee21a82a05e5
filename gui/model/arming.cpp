#include "gui/model/arming.hpp"

#include <ros/init.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "doors/guarded_call.hpp"
#include "gui/model/clock.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kGateAnswers = 1.0;  // s within which the gate must have spoken to be armed
constexpr int kCanArmTries = 50;      // of 10 ms, until the gate has heard that the stop is back

std::string tooOld(const ArmWish& wish) {
  const double age = steadySeconds() - wish.at;
  if (age <= kArmWishHolds) return {};
  char text[80];
  std::snprintf(text, sizeof text, "it took %.1f s to reach the gate. Hold again", age);
  return text;
}

std::string gateNotReady(const ConsoleState& state) {
  const FeedState feed = state.gate.state(steadySeconds());
  if (!feed.ever || feed.age_s > kGateAnswers) return "no stop gate answers";
  // A stop that it has not heard would be lost when the helm takes it back.
  if (state.gate.latest()->phase != GatePhase::kStopped) return "the gate has not confirmed a stop";
  return {};
}

// Connected to before it is called: what asks the master may hang, and the call would then reach
// the gate long after anybody wished it.
class GateArmService : public ArmService {
 public:
  std::string find() override {
    const std::string name = node_.resolveName("stop_gate/arm");
    client_ = node_.serviceClient<std_srvs::Trigger>(name, true);
    return client_.isValid() ? std::string() : "no service " + name;
  }
  std::string call() override {
    std_srvs::Trigger::Request request;
    GuardedResponse<std_srvs::Trigger::Response> answer;
    const std::string sum = ros::service_traits::md5sum<std_srvs::Trigger>();
    if (!client_.call(request, answer, sum)) return client_.getService() + " failed";
    if (answer.message.success) return {};
    return answer.message.message.empty() ? "the gate refused" : answer.message.message;
  }

 private:
  ros::NodeHandle node_;
  ros::ServiceClient client_;
};

}  // namespace

std::string arm(ArmService& service, const ConsoleState& state, Helm* helm, const ArmWish& wish) {
  const auto hindrance = [&] {
    std::string why = tooOld(wish);
    if (why.empty()) why = gateNotReady(state);
    if (why.empty() && helm && helm->stops() != wish.stops) why = "a stop was pressed meanwhile";
    return why;
  };
  std::string why = hindrance();
  if (why.empty()) why = service.find();
  if (why.empty()) why = hindrance();
  if (!why.empty()) return why;
  if (helm) helm->release(wish.stops);
  // Called too early the service would refuse: the gate has not yet heard that the stop is back.
  for (int i = 0; i < kCanArmTries && !state.gate.latest()->can_arm; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  why = hindrance();
  return why.empty() ? service.call() : why;
}

std::string armTheGate(const ConsoleState& state, Helm* helm, const ArmWish& wish) {
  if (!ros::isStarted()) return "no connection to the robot";
  GateArmService service;
  return arm(service, state, helm, wish);
}

}  // namespace pilothouse::gui
