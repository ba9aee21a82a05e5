#include "bench/stop_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bench/json_line.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kZeroP99 = 0.35, kZeroMost = 0.5, kUpMost = 5.0;  // [s]
constexpr double kAppearanceP99 = 0.15, kAppearanceMost = 0.25;    // [s]
constexpr double kResumeMost = 5.0;                                // [s]
constexpr std::size_t kSpoilt = 10;  // a busy computer may spoil one appearance in so many
constexpr double kMoved = 0.01;      // less is the noise of standing still [m]

std::vector<double> zeroTimes(const std::vector<StopResult>& results, const std::string& fault) {
  std::vector<double> times;
  for (const StopResult& result : results)
    if (fault.empty() || result.fault == fault) times.push_back(result.to_zero);
  return times;
}

bool movedBeforeArming(const StopResult& result) {
  return result.commands_after > 0 || !(result.moved < kMoved);
}

void addTimes(JsonLine& line, const std::vector<double>& times) {
  line.number("p50", quantile(times, 0.5)).number("p99", quantile(times, 0.99));
  line.number("max", quantile(times, 1.0));
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  for (double& value : values)
    if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
  std::sort(values.begin(), values.end());
  const double last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::ceil(share * last))];
}

std::string jsonOf(const StopResult& result, int number) {
  JsonLine line;
  line.text("eval", "stop").whole("number", number).text("fault", result.fault);
  line.number("to_zero", result.to_zero).number("up_again", result.up_again);
  line.whole("commands_before_arming", result.commands_after).number("moved", result.moved);
  if (result.in_flight > 0) line.whole("in_flight", result.in_flight);
  return line.text("cause", result.cause).str();
}

std::string jsonOf(const AppearanceResult& result, int number) {
  JsonLine line;
  line.text("eval", "stop").whole("appearance", number).number("speed", result.speed);
  line.number("to_zero", result.to_zero).number("from_place", result.from_place);
  line.whole("commands_after", result.commands_after).whole("contacts", result.contacts);
  line.number("resumed", result.resumed).truth("stopped", result.stopped);
  if (result.stopped) line.truth("beforehand", result.beforehand).text("cause", result.cause);
  if (!result.held_by.empty()) line.text("held_by", result.held_by);
  return line.str();
}

std::vector<std::string> jsonByKind(const std::vector<StopResult>& results) {
  std::map<std::string, int> kinds;
  for (const StopResult& result : results) ++kinds[result.fault];
  std::vector<std::string> lines;
  for (const auto& [fault, count] : kinds) {
    JsonLine line;
    line.text("eval", "stop").text("kind", fault).whole("count", count);
    addTimes(line, zeroTimes(results, fault));
    double up = 0.0;
    int moved = 0;
    for (const StopResult& result : results) {
      if (result.fault != fault) continue;
      up = std::max(up, result.up_again);
      moved += movedBeforeArming(result) ? 1 : 0;
    }
    lines.push_back(line.number("up_again_max", up).whole("moved_before_rearming", moved).str());
  }
  return lines;
}

StopSummary summaryOf(const std::vector<StopResult>& faults,
                      const std::vector<AppearanceResult>& appearances, int false_stops) {
  const std::vector<double> zero = zeroTimes(faults, "");
  std::vector<double> appeared, up, resumed;
  std::size_t stopped = 0, commands_after = 0, contacts = 0;
  for (const AppearanceResult& a : appearances) {
    stopped += a.stopped ? 1 : 0;
    contacts += a.contacts;
    commands_after += static_cast<std::size_t>(a.commands_after);
    if (!a.beforehand) appeared.push_back(a.to_zero);
    if (!a.stopped) resumed.push_back(a.resumed);
  }
  int moved = 0;
  for (const StopResult& result : faults) {
    moved += movedBeforeArming(result) ? 1 : 0;
    up.push_back(result.up_again);
  }
  JsonLine line;
  line.text("eval", "stop").truth("summary", true);
  StopSummary summary;
  summary.pass = true;
  if (!faults.empty()) {
    summary.pass = quantile(zero, 0.99) <= kZeroP99 && quantile(zero, 1.0) <= kZeroMost &&
                   moved == 0 && quantile(up, 1.0) <= kUpMost;
  }
  if (!appearances.empty()) {
    summary.pass = summary.pass && quantile(appeared, 0.99) <= kAppearanceP99 &&
                   quantile(appeared, 1.0) <= kAppearanceMost && quantile(appeared, 0.0) >= 0.0 &&
                   quantile(resumed, 1.0) <= kResumeMost && commands_after == 0 && contacts == 0 &&
                   kSpoilt * stopped < appearances.size() + kSpoilt;
  }
  line.truth("pass", summary.pass).whole("faults", faults.size());
  addTimes(line, zero);
  line.whole("moved_before_rearming", moved).number("up_again_max", quantile(up, 1.0));
  line.whole("false_stops", false_stops).whole("appearances", appearances.size());
  line.whole("appearances_spoilt", stopped);
  line.whole("appearance_commands_after", commands_after).whole("contacts", contacts);
  line.number("appearance_p50", quantile(appeared, 0.5));
  line.number("appearance_p99", quantile(appeared, 0.99));
  line.number("appearance_max", quantile(appeared, 1.0));
  line.number("resume_p50", quantile(resumed, 0.5)).number("resume_p99", quantile(resumed, 0.99));
  line.number("resume_max", quantile(resumed, 1.0));
  summary.json = line.str();
  return summary;
}

}  // namespace pilothouse::bench
