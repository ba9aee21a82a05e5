#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "core/motion/parameter_ranges.hpp"
#include "doors/avoidance_settings.hpp"

namespace pilothouse {
namespace {

/// The numbers of a configuration by their keys, by way of its message (so that a key which this
/// test does not know of cannot be forgotten).
std::map<std::string, double> numbersOf(const AvoidanceConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  std::map<std::string, double> numbers;
  for (const auto& entry : message.doubles) numbers[entry.name] = entry.value;
  for (const auto& entry : message.ints) numbers[entry.name] = entry.value;
  return numbers;
}

struct Ranges {
  std::map<std::string, double> value, low, high;
};
Ranges rangesOf(const AvoidanceParameters& parameters) {
  Ranges ranges;
  forEachAvoidanceParameter(
      parameters, [&ranges](const char* key, const auto& value, const auto& low, const auto& high) {
        ranges.value[key] = value;
        ranges.low[key] = low;
        ranges.high[key] = high;
      });
  return ranges;
}

TEST(AvoidanceSettings, DefaultsAndRangesOfTheConfigAreThoseOfTheStruct) {
  const Ranges ranges = rangesOf({});
  EXPECT_EQ(ranges.value.size(), 20U);
  EXPECT_EQ(numbersOf(AvoidanceConfig::__getDefault__()), ranges.value);
  EXPECT_EQ(numbersOf(AvoidanceConfig::__getMin__()), ranges.low);
  EXPECT_EQ(numbersOf(AvoidanceConfig::__getMax__()), ranges.high);
}

TEST(AvoidanceSettings, EveryParameterSurvivesTheWayToAConfigAndBack) {
  AvoidanceParameters parameters;
  forEachAvoidanceParameter(parameters,
                            [](const char*, auto& value, auto, auto high) { value = high; });
  EXPECT_EQ(rangesOf(fromConfig(toConfig(parameters))).value, rangesOf(parameters).value);
}

std::string faultOf(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue values;
  values[key] = value;
  StrictParameters reader("/avoidance", values);
  reader.quiet();
  AvoidanceParameters parameters;
  readAvoidanceParameters(reader, parameters);
  try {
    reader.finish();
  } catch (const ParameterFault& fault) {
    return fault.what();
  }
  return "";
}

TEST(AvoidanceSettings, EveryKeyRefusesTextNanAndWhatIsOutOfRangeNamingItself) {
  const Ranges ranges = rangesOf({});
  for (const auto& [key, high] : ranges.high) {
    const bool whole = key == "confirm_frames" || key == "confirm_of";
    const auto number = [whole](double value) {
      return whole ? XmlRpc::XmlRpcValue(static_cast<int>(value)) : XmlRpc::XmlRpcValue(value);
    };
    for (const auto& bad : {XmlRpc::XmlRpcValue("much"), XmlRpc::XmlRpcValue(true),
                            XmlRpc::XmlRpcValue(std::numeric_limits<double>::quiet_NaN()),
                            number(ranges.low.at(key) - 1.0), number(high + 1.0)}) {
      EXPECT_EQ(faultOf(key, bad).rfind("/avoidance: " + key + " is ", 0), 0U) << faultOf(key, bad);
    }
    EXPECT_NE(faultOf(key + "s", number(high)).find("is not a parameter"), std::string::npos);
  }
  EXPECT_EQ(faultOf("stop_distance", 0.3), "");
}

TEST(AvoidanceSettings, AWrongCombinationIsRefused) {
  EXPECT_NE(faultOf("confirm_frames", 4).find("confirm_frames is 4"), std::string::npos);
}

}  // namespace
}  // namespace pilothouse
