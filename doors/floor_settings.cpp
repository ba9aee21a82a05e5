#include "doors/floor_settings.hpp"

#include <stdexcept>

namespace pilothouse {
namespace {

/// Calls visit(key, member of each struct...) for every parameter but the method; FloorParameters
/// and FloorConfig name them alike.
template <class Visit, class... Structs>
void forEachKey(Visit visit, Structs&... structs) {
  visit("cell_size", structs.cell_size...);
  visit("range", structs.range...);
  visit("half_width", structs.half_width...);
  visit("clear_height", structs.clear_height...);
  visit("threshold_deviation", structs.threshold_deviation...);
  visit("obstacle_deviation", structs.obstacle_deviation...);
  visit("calibrate_mounting", structs.calibrate_mounting...);
  visit("x_min", structs.x_min...);
  visit("depth_below", structs.depth_below...);
  visit("step_height", structs.step_height...);
  visit("seed_height", structs.seed_height...);
  visit("min_points", structs.min_points...);
  visit("noise_floor", structs.noise_floor...);
  visit("noise_slope", structs.noise_slope...);
}

template <class T>
void readOne(StrictParameters& reader, const char* key, T& value, T low, T high) {
  reader.read(key, value, low, high);
}
void readOne(StrictParameters& reader, const char* key, bool& value, bool, bool) {
  reader.read(key, value);
}

const char* nameOf(FloorMethod method) {
  return method == FloorMethod::kOriginal ? "original" : "improved";
}

}  // namespace

void readFloorParameters(StrictParameters& reader, FloorParameters& parameters) {
  std::string method = nameOf(parameters.method);
  reader.read("method", method, {"original", "improved"});
  parameters.method = method == "original" ? FloorMethod::kOriginal : FloorMethod::kImproved;
  forEachKey([&reader](const char* key, auto& value, const auto& low,
                       const auto& high) { readOne(reader, key, value, low, high); },
             parameters, FloorConfig::__getMin__(), FloorConfig::__getMax__());
  for (const auto& fault : validate(parameters)) reader.addFault(fault);
}

FloorConfig toConfig(const FloorParameters& parameters) {
  FloorConfig config = FloorConfig::__getDefault__();
  config.method = nameOf(parameters.method);
  forEachKey([](const char*, const auto& from, auto& to) { to = from; }, parameters, config);
  return config;
}

FloorParameters fromConfig(const FloorConfig& config) {
  if (config.method != "original" && config.method != "improved") {
    throw std::invalid_argument("method is \"" + config.method +
                                "\", expected original or improved");
  }
  FloorParameters parameters;
  parameters.method = config.method == "original" ? FloorMethod::kOriginal : FloorMethod::kImproved;
  forEachKey([](const char*, const auto& from, auto& to) { to = from; }, config, parameters);
  return parameters;
}

}  // namespace pilothouse
