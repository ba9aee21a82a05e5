#pragma once

#include <std_srvs/Trigger.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "gate/gate_inbox.hpp"
#include "gate/gate_messages.hpp"
#include "gate/publisher_watch.hpp"

namespace pilothouse {

/// The stop gate with its threads: the beat, which waits for nobody; the inputs; the services; and
/// one that talks to master, log and diagnostics.
class GateProcess {
 public:
  GateProcess(const GateParameters& parameters, ros::NodeHandle& handle);
  /// Publishes a last zero.
  ~GateProcess();

 private:
  void beat();
  void beatOnce(GateInputs& inputs);
  void share(GateReport&& report, const GateInputs& inputs);
  void report();
  void reportOnce(const GateReport& now, StopCause& told);
  diagnostic_msgs::DiagnosticStatus diagnostic(const GateReport& report);
  bool arm(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool stop(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  void waitUntilHandled(std::unique_lock<std::mutex>& lock, const std::uint32_t& handled,
                        std::uint32_t request);

  const GateParameters parameters_;
  GateInbox inbox_;
  PublisherWatch watch_;
  ros::Publisher commands_, states_, diagnostics_;

  // Only the beat's.
  GateState state_;
  GateInbox::Names names_{};
  PublisherWatch::Seen seen_;

  // What the beat shows to the others; it never waits for this lock.
  std::mutex mutex_;
  std::condition_variable changed_;
  GateReport newest_;
  std::uint32_t stops_handled_ = 0, arms_handled_ = 0;

  std::atomic<bool> ending_{false};
  std::atomic<double> longest_beat_{0.0};  ///< between two beats since the last report [s]
  std::string not_real_time_;              ///< written before the first beat
  std::thread reporter_, beat_;

  // Last: the spinner ends before anything that the services use.
  ros::CallbackQueue services_queue_;
  ros::ServiceServer arm_, stop_;
  ros::AsyncSpinner services_spinner_{1, &services_queue_};
};

}  // namespace pilothouse
