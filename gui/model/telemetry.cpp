#include "gui/model/telemetry.hpp"

#include <algorithm>

#include "gui/model/drive_words.hpp"

namespace pilothouse::gui {

namespace {

// Distances change with every report; what is about another thing does not differ by them alone.
bool sameButForFigures(const std::string& a, const std::string& b) {
  const auto figure = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
  auto i = a.begin(), j = b.begin();
  for (;; ++i, ++j) {
    i = std::find_if_not(i, a.end(), figure);
    j = std::find_if_not(j, b.end(), figure);
    if (i == a.end() || j == b.end()) return i == a.end() && j == b.end();
    if (*i != *j) return false;
  }
}

}  // namespace

void Telemetry::rule(double now, Rule rule, const std::string& words) {
  auto& rules = curves_.rules;
  if (!rules.empty() && now - rules.back().until <= Trace::kGap) {
    rules.back().until = now;
    if (rules.back().rule == rule && sameButForFigures(rules.back().words, words)) return;
  }
  rules.push_back({now, now, rule, words});
  if (rules.size() > kMostChanges) rules.pop_front();
}

void Telemetry::limit(double now, const LimitReading& r) {
  const std::lock_guard<std::mutex> lock(mutex_);
  curves_.wanted.add(now, r.wanted);
  curves_.limited.add(now, r.limited);
  curves_.measured.add(now, r.measured);
  curves_.limit.add(now, r.limit);
  curves_.obstacle.add(now, r.obstacle_distance);
  curves_.potential.add(now, r.potential_distance);
  if (now - stopped_at_ > Trace::kGap) rule(now, static_cast<Rule>(r.cause), limitWords(r));
}

void Telemetry::stop(double now, const StopReading& r) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool stopped = r.phase == GatePhase::kStopped;
  stopped_at_ = stopped ? now : -1e9;
  if (stopped) rule(now, Rule::kStopped, stopWords(r));
}

void Telemetry::wheels(double now, const std::vector<WheelReading>& wheels) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& wheel : wheels) {
    if (curves_.wheels.size() >= kMostNames && curves_.wheels.count(wheel.name) == 0) continue;
    curves_.wheels[wheel.name].add(now, wheel.rate);
  }
}

void Telemetry::range(double now, const RangeReading& r) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (curves_.ranges.size() >= kMostNames && curves_.ranges.count(r.name) == 0) return;
  curves_.ranges[r.name].add(now, r.range);
}

}  // namespace pilothouse::gui
