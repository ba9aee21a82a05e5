#include "doors/avoidance_settings.hpp"

#include <dynamic_reconfigure/Config.h>

#include "core/motion/parameter_ranges.hpp"

namespace pilothouse {
namespace {

void add(dynamic_reconfigure::Config& message, const char* key, double value) {
  message.doubles.emplace_back();
  message.doubles.back().name = key;
  message.doubles.back().value = value;
}
void add(dynamic_reconfigure::Config& message, const char* key, int value) {
  message.ints.emplace_back();
  message.ints.back().name = key;
  message.ints.back().value = value;
}

void take(const dynamic_reconfigure::Config& message, const char* key, double& value) {
  for (const auto& entry : message.doubles) {
    if (entry.name == key) value = entry.value;
  }
}
void take(const dynamic_reconfigure::Config& message, const char* key, int& value) {
  for (const auto& entry : message.ints) {
    if (entry.name == key) value = entry.value;
  }
}

}  // namespace

void readAvoidanceParameters(StrictParameters& reader, AvoidanceParameters& parameters) {
  const std::size_t before = reader.faultCount();
  forEachAvoidanceParameter(
      parameters, [&reader](const char* key, auto& value, const auto& low, const auto& high) {
        reader.read(key, value, low, high);
      });
  if (reader.faultCount() > before) return;
  for (const auto& fault : validate(parameters)) reader.addFault(fault);
}

AvoidanceConfig toConfig(const AvoidanceParameters& parameters) {
  AvoidanceConfig config = AvoidanceConfig::__getDefault__();
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  message.doubles.clear();
  message.ints.clear();
  forEachAvoidanceParameter(parameters, [&message](const char* key, const auto& value, const auto&,
                                                   const auto&) { add(message, key, value); });
  config.__fromMessage__(message);
  return config;
}

AvoidanceParameters fromConfig(const AvoidanceConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  AvoidanceParameters parameters;
  forEachAvoidanceParameter(parameters, [&message](const char* key, auto& value, const auto&,
                                                   const auto&) { take(message, key, value); });
  return parameters;
}

}  // namespace pilothouse
