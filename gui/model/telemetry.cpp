#include "gui/model/telemetry.hpp"

#include "gui/model/drive_words.hpp"

namespace pilothouse::gui {

void Telemetry::rule(double now, Rule rule, const std::string& words) {
  auto& rules = curves_.rules;
  if (!rules.empty() && rules.back().rule == rule) return;
  rules.push_back({now, rule, words});
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
  if (!stopped_) rule(now, static_cast<Rule>(r.cause), limitWords(r));
}

void Telemetry::stop(double now, const StopReading& r) {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = r.phase == GatePhase::kStopped;
  if (stopped_) rule(now, Rule::kStopped, stopWords(r));
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
