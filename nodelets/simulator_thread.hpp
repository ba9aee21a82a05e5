#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "nodelets/simulator_outputs.hpp"
#include "nodelets/simulator_pace.hpp"
#include "nodelets/simulator_settings.hpp"

namespace pilothouse {

/// Runs a simulation in a thread of its own, from construction to destruction, and publishes what
/// it reads. Without /clock, simulated time runs with the steady clock and stamps are wall time.
class SimulatorThread {
 public:
  using Task = std::function<std::optional<std::string>(sim::Simulation&)>;

  SimulatorThread(ros::NodeHandle& handle, SimulatorSettings settings);
  ~SimulatorThread();

  /// A command for the base has arrived.
  void command(const Twist2& twist);
  /// Runs a task between two ticks. @return what it returned, or a reason why it could not run.
  std::optional<std::string> between(const Task& task);
  /// The world, the robot and its sensors as at the start; time goes on.
  void reset();
  /// Only within a task.
  ros::Time stampOf(double simulated) const { return epoch_ + ros::Duration(simulated); }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  struct Command {
    Twist2 twist;
    SimulatorPace::Clock::time_point arrival;
  };

  void run();
  void tick();
  void obey();
  void followWallTime();
  void runTasks();
  void waitForNext();
  void keepFigures();

  SimulatorSettings settings_;
  std::unique_ptr<sim::Simulation> simulation_;
  SimulatorOutputs outputs_;
  ros::Publisher clock_;
  SimulatorPace pace_;
  ros::Time epoch_;  ///< of simulated time 0

  std::mutex mutex_;  ///< of all below
  std::condition_variable wake_;
  bool stopping_ = false;
  std::optional<Command> command_;
  bool command_is_new_ = false;
  std::vector<std::packaged_task<std::optional<std::string>()>> tasks_;
  struct Figures {
    double factor = 0.0, time = 0.0;
    std::uint64_t given_up = 0;
    std::size_t contacts = 0;
    std::string failing;  ///< sensors that were made to
    sim::PartTimes times;
  } figures_;
  std::thread thread_;
};

}  // namespace pilothouse
