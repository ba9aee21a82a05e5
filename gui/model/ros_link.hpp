#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "gui/model/console_state.hpp"
#include "gui/model/errand_thread.hpp"
#include "gui/model/helm.hpp"
#include "gui/model/place_asks.hpp"

namespace pilothouse::gui {

class RosStreams;

/// Keeps the connection to the ROS master on a thread of its own: waits for a master, subscribes,
/// notices when it goes or is replaced and subscribes anew. The GUI thread never calls ROS.
class RosLink {
 public:
  /// @param arguments the command line; remappings (name:=value) are taken from it.
  /// @param helm gets its topics from the connection; may be null. Outlives the link.
  RosLink(std::vector<std::string> arguments, ConsoleState& state, Helm* helm = nullptr);
  ~RosLink();
  RosLink(const RosLink&) = delete;
  RosLink& operator=(const RosLink&) = delete;

  void start();
  /// Ends the threads. @return false when a call into ROS did not come back within `patience` [s]:
  /// the process must then end without waiting for it.
  bool stop(double patience);
  /// Somebody has ended this node, as `rosnode kill` does: nothing is published any more.
  bool killed() const { return killed_; }
  /// Asks the floor nodelet for a change of its parameters; the answer comes in floor_settings.
  void askFloor(const std::string& method, bool calibrate);
  /// Takes back the stops up to this one and asks the stop gate to let the robot drive again, on a
  /// thread of its own that nothing else holds up; how it goes stands in state.arming.
  void askArm(StopSerial stops);
  /// What the operator asks about the place. The action runs with the connection's errands; without
  /// a connection the answer says so.
  void askPlace(const std::function<void(PlaceAsks&)>& ask);

 private:
  void run();
  bool connectedStep();
  void endErrands();
  void setPhase(LinkPhase phase, double round_trip_ms);
  void pause(double seconds);

  std::vector<std::string> arguments_;
  ConsoleState& state_;
  Helm* helm_;
  std::unique_ptr<RosStreams> streams_;
  Guarded<std::shared_ptr<PlaceAsks>> errands_;
  std::unique_ptr<ErrandThread> arming_, floor_;  ///< used by the GUI thread
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::string master_id_;
  std::atomic<bool> killed_{false};
  bool stopping_ = false;
  bool ended_ = false;
};

}  // namespace pilothouse::gui
