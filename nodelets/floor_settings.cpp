#include "nodelets/floor_settings.hpp"

#include <stdexcept>

namespace pilothouse {
namespace {

/// Calls visit(key, member of a, member of b) for each parameter that both structs name alike.
template <class A, class B, class Visit>
void forEachKey(A& a, B& b, Visit visit) {
  visit("cell_size", a.cell_size, b.cell_size);
  visit("range", a.range, b.range);
  visit("half_width", a.half_width, b.half_width);
  visit("clear_height", a.clear_height, b.clear_height);
  visit("threshold_deviation", a.threshold_deviation, b.threshold_deviation);
  visit("obstacle_deviation", a.obstacle_deviation, b.obstacle_deviation);
  visit("calibrate_mounting", a.calibrate_mounting, b.calibrate_mounting);
  visit("x_min", a.x_min, b.x_min);
  visit("depth_below", a.depth_below, b.depth_below);
  visit("step_height", a.step_height, b.step_height);
  visit("seed_height", a.seed_height, b.seed_height);
  visit("min_points", a.min_points, b.min_points);
  visit("noise_floor", a.noise_floor, b.noise_floor);
  visit("noise_slope", a.noise_slope, b.noise_slope);
}

const char* nameOf(FloorMethod method) {
  return method == FloorMethod::kOriginal ? "original" : "improved";
}

}  // namespace

void readFloorParameters(StrictParameters& reader, FloorParameters& parameters) {
  std::string method = nameOf(parameters.method);
  reader.read("method", method, {"original", "improved"});
  parameters.method = method == "original" ? FloorMethod::kOriginal : FloorMethod::kImproved;
  forEachKey(parameters, parameters,
             [&reader](const char* key, auto& value, auto&) { reader.read(key, value); });
  for (const auto& fault : validate(parameters)) reader.addFault(fault);
}

FloorConfig toConfig(const FloorParameters& parameters) {
  FloorConfig config = FloorConfig::__getDefault__();
  config.method = nameOf(parameters.method);
  forEachKey(parameters, config, [](const char*, const auto& from, auto& to) { to = from; });
  return config;
}

FloorParameters fromConfig(const FloorConfig& config) {
  if (config.method != "original" && config.method != "improved") {
    throw std::invalid_argument("method is \"" + config.method +
                                "\", expected original or improved");
  }
  FloorParameters parameters;
  parameters.method = config.method == "original" ? FloorMethod::kOriginal : FloorMethod::kImproved;
  forEachKey(config, parameters, [](const char*, const auto& from, auto& to) { to = from; });
  return parameters;
}

}  // namespace pilothouse
