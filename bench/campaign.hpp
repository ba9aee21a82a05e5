#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "bench/floor_bars.hpp"
#include "bench/json_line.hpp"
#include "doors/robot_description.hpp"

namespace pilothouse::bench {

/// A robot of each base. None of the package rolls on mecanum wheels: the platform's body does.
std::vector<RobotDescription> campaignRobots();

/// Prints each bar with its figure to stderr. @return whether all are met.
bool tellBars(const std::vector<Bar>& bars);

/// run(task) for every task, on two threads; done(result) in the tasks' order, each as soon as
/// those before are done, never two at once. What a run throws ends it all.
template <class Task, class Run, class Done>
void runCampaign(const std::vector<Task>& tasks, Run run, Done done) {
  std::vector<std::optional<decltype(run(tasks.front()))>> results(tasks.size());
  std::atomic<std::size_t> next{0};
  std::size_t told = 0;
  std::exception_ptr fault;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < tasks.size(); i = next++) {
        auto result = run(tasks[i]);
        const std::lock_guard<std::mutex> lock(mutex);
        results[i] = std::move(result);
        for (; told < results.size() && results[told]; ++told) {
          done(*results[told]);
          results[told].reset();
        }
      }
    } catch (...) {
      next = tasks.size();
      const std::lock_guard<std::mutex> lock(mutex);
      fault = std::current_exception();
    }
  };
  std::thread other(work);
  work();
  other.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace pilothouse::bench
