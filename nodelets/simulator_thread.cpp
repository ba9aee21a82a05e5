#include "nodelets/simulator_thread.hpp"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <rosgraph_msgs/Clock.h>

#include <cmath>
#include <utility>

namespace pilothouse {
namespace {

using Clock = SimulatorPace::Clock;

constexpr double kClockStart = 1.0;  // 0 means to ROS that there is no time yet [s]
constexpr double kJump = 0.05;       // wall time that is off by more is followed at once [s]
constexpr double kFollow = 0.01;     // else by this share a tick
constexpr double kSlow = 0.95;       // a lower real-time factor is a warning

}  // namespace

SimulatorThread::SimulatorThread(ros::NodeHandle& handle, SimulatorSettings settings)
    : settings_(std::move(settings)),
      simulation_(std::make_unique<sim::Simulation>(settings_.world, settings_.robot,
                                                    settings_.parameters)),
      outputs_(handle, settings_.robot, settings_.parameters.sensors, settings_.camera_frame,
               settings_.world),
      pace_(settings_.rate, sim::Simulation::kTick),
      epoch_(settings_.clock ? ros::Time(kClockStart) : ros::Time(0)) {
  if (settings_.clock) clock_ = handle.advertise<rosgraph_msgs::Clock>("/clock", 10);
  thread_ = std::thread([this] { run(); });
}

SimulatorThread::~SimulatorThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void SimulatorThread::command(const Twist2& twist) {
  const std::lock_guard<std::mutex> lock(mutex_);
  command_ = Command{twist, Clock::now()};
  command_is_new_ = true;
}

std::optional<std::string> SimulatorThread::between(const Task& task) {
  std::future<std::optional<std::string>> answer;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return "the simulator is ending";
    tasks_.emplace_back([this, &task] { return task(*simulation_); });
    answer = tasks_.back().get_future();
  }
  wake_.notify_all();
  return answer.get();
}

void SimulatorThread::reset() {
  between([this](sim::Simulation& before) {
    epoch_ = stampOf(before.time());
    simulation_ =
        std::make_unique<sim::Simulation>(settings_.world, settings_.robot, settings_.parameters);
    return std::nullopt;
  });
}

void SimulatorThread::run() {
  pace_.start(Clock::now());
  while (true) {
    runTasks();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (stopping_ && tasks_.empty()) return;
    }
    if (pace_.next() <= Clock::now()) tick();
    waitForNext();
  }
}

void SimulatorThread::tick() {
  obey();
  if (!settings_.clock) followWallTime();
  const sim::Readings& readings = simulation_->step();
  if (settings_.clock) {
    rosgraph_msgs::Clock now;
    now.clock = stampOf(readings.time);
    clock_.publish(now);
  }
  outputs_.publish(*simulation_, readings, [this](double simulated) { return stampOf(simulated); });
  pace_.ticked(Clock::now());
  keepFigures();
}

/// The tick's stamp shall be the wall time at which it was due. Wall time is set and slewed by
/// others, and goes on when ticks are given up.
void SimulatorThread::followWallTime() {
  const std::chrono::duration<double> late = Clock::now() - pace_.next();
  const ros::Time due = ros::Time::now() - ros::Duration(late.count());
  const ros::Time stamp = stampOf(simulation_->time() + sim::Simulation::kTick);
  const double error = (due - stamp).toSec();
  epoch_ += ros::Duration(std::abs(error) > kJump ? error : kFollow * error);
}

/// In real time a command's age is its age by the steady clock, also while late ticks are made up
/// for. With a clock of its own, simulated time alone counts.
void SimulatorThread::obey() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!command_) return;
  const std::chrono::duration<double> age = Clock::now() - command_->arrival;
  const bool in_time = age.count() <= settings_.robot.base.command_timeout;
  if (settings_.clock ? command_is_new_ : in_time) {
    simulation_->command(command_->twist);
  } else if (!settings_.clock) {
    simulation_->forgetCommand();
  }
  command_is_new_ = false;
}

void SimulatorThread::runTasks() {
  std::vector<std::packaged_task<std::optional<std::string>()>> tasks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks.swap(tasks_);
  }
  for (auto& task : tasks) task();
}

void SimulatorThread::waitForNext() {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait_until(lock, pace_.next(), [this] { return stopping_ || !tasks_.empty(); });
}

void SimulatorThread::keepFigures() {
  std::string failing;
  for (const auto& name : simulation_->sensors().failing(simulation_->time())) {
    failing += (failing.empty() ? "" : ", ") + name;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  figures_ = {pace_.factor(),  simulation_->time(),
              pace_.givenUp(), simulation_->base().contacts().size(),
              failing,         simulation_->times()};
}

void SimulatorThread::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  Figures figures;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    figures = figures_;
  }
  const bool slow = settings_.rate > 0.0 && figures.factor < kSlow * settings_.rate;
  if (!figures.failing.empty())
    status.summary(DiagnosticStatus::WARN, "made to fail: " + figures.failing);
  else if (slow)
    status.summary(DiagnosticStatus::WARN, "slower than it should be");
  else
    status.summary(DiagnosticStatus::OK, "simulating " + settings_.world.name);
  status.addf("real-time factor", "%.3f", figures.factor);
  status.addf("simulated seconds", "%.2f", figures.time);
  status.add("times that the past was given up", figures.given_up);
  status.add("contacts", figures.contacts);
  for (int i = 0; i < sim::PartTimes::kParts; ++i) {
    const auto part = static_cast<sim::PartTimes::Part>(i);
    const auto times = figures.times.times(part);
    if (times == 0) continue;
    status.addf(std::string(sim::PartTimes::kNames[static_cast<std::size_t>(i)]) + " [ms]", "%.3f",
                1e3 * figures.times.seconds(part) / static_cast<double>(times));
  }
}

}  // namespace pilothouse
