#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pilothouse::bench {

/// One thing to be measured.
struct TimedCase {
  std::string name;
  std::function<void()> work;
  std::function<void()> before;  ///< not measured; empty: `work` itself, so that caches are warm
  bool slow = false;             ///< measured in few of the rounds
  std::optional<double> limit;   ///< greatest ratio to the yardstick's median
  std::vector<double> times_ms{};
};

/// A clock [s].
using Clock = double (*)();
double steadySeconds();
double threadSeconds();  ///< of a core, for the calling thread: whatever else the computer does

/// Times of every case in rounds, one after the other, so that all see the same weather.
void measure(std::vector<TimedCase>& cases, int rounds, int slow_rounds,
             Clock clock = steadySeconds);

/// Value at `share` (0..1) of the sorted times. @param times not empty.
double quantile(std::vector<double> times, double share);

/// Prints a table and writes a JSON line a case to `out_file` (empty: none).
/// @param yardstick name of the case whose median is 1.
/// @return the cases above their limit, each with its ratio.
std::vector<std::string> report(const std::string& bench, const std::vector<TimedCase>& cases,
                                const std::string& yardstick, const std::string& out_file);

/// Keeps this process on the processor that it runs on. @return its number, -1 if refused.
int pinToOneProcessor();

}  // namespace pilothouse::bench
