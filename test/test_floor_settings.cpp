#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "doors/floor_settings.hpp"

namespace pilothouse {
namespace {

using Description = FloorConfig::AbstractParamDescriptionConstPtr;

/// The numbers of a configuration by their keys, by way of its message (so that a key which this
/// test does not know of cannot be forgotten).
std::map<std::string, double> numbersOf(const FloorConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  std::map<std::string, double> numbers;
  for (const auto& entry : message.doubles) numbers[entry.name] = entry.value;
  for (const auto& entry : message.ints) numbers[entry.name] = entry.value;
  return numbers;
}

FloorParameters withNumber(const std::string& key, double value) {
  FloorConfig config = FloorConfig::__getDefault__();
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  for (auto& entry : message.doubles) {
    if (entry.name == key) entry.value = value;
  }
  for (auto& entry : message.ints) {
    if (entry.name == key) entry.value = static_cast<int>(value);
  }
  config.__fromMessage__(message);
  return fromConfig(config);
}

/// Whether validate() refuses the range of exactly this key; limits that cross with another's
/// default are a fault of the combination, not of the range.
bool refusesRange(const std::string& key, double value) {
  FloorParameters p = withNumber(key, value);
  if (key == "threshold_deviation") p.obstacle_deviation = 0.5;
  if (key == "obstacle_deviation") p.threshold_deviation = 0.001;
  if (key == "x_min") p.range = 20.0;
  if (key == "range") p.x_min = -20.0;
  if (key == "cell_size") p.range = 20.0;
  for (const auto& fault : validate(p)) {
    if (fault.rfind(key + " is", 0) == 0) return true;
  }
  return false;
}

TEST(FloorSettings, DefaultsOfTheConfigAreThoseOfTheStruct) {
  const auto from_struct = numbersOf(toConfig(FloorParameters{}));
  EXPECT_EQ(from_struct.size(), 13U);
  EXPECT_EQ(from_struct, numbersOf(FloorConfig::__getDefault__()));
  const FloorConfig config = toConfig(FloorParameters{});
  EXPECT_EQ(config.method, FloorConfig::__getDefault__().method);
  EXPECT_EQ(config.calibrate_mounting, FloorConfig::__getDefault__().calibrate_mounting);
}

TEST(FloorSettings, RangesOfTheConfigAreThoseOfValidate) {
  const auto low = numbersOf(FloorConfig::__getMin__());
  const auto high = numbersOf(FloorConfig::__getMax__());
  for (const auto& entry : low) {
    const std::string& key = entry.first;
    const double beyond = key == "min_points" ? 1.0 : 1e-6;
    EXPECT_FALSE(refusesRange(key, entry.second)) << key << " at its minimum";
    EXPECT_FALSE(refusesRange(key, high.at(key))) << key << " at its maximum";
    EXPECT_TRUE(refusesRange(key, entry.second - beyond)) << key << " below its minimum";
    EXPECT_TRUE(refusesRange(key, high.at(key) + beyond)) << key << " above its maximum";
  }
}

TEST(FloorSettings, EveryParameterSurvivesTheWayToAConfigAndBack) {
  for (const auto& entry : numbersOf(FloorConfig::__getMax__())) {
    const auto there = numbersOf(toConfig(withNumber(entry.first, entry.second)));
    EXPECT_EQ(there.at(entry.first), entry.second) << entry.first;
  }
  FloorParameters p;
  p.method = FloorMethod::kOriginal;
  p.calibrate_mounting = true;
  EXPECT_EQ(fromConfig(toConfig(p)).method, FloorMethod::kOriginal);
  EXPECT_TRUE(fromConfig(toConfig(p)).calibrate_mounting);
}

TEST(FloorSettings, AMethodThatDoesNotExistIsRefused) {
  FloorConfig config = FloorConfig::__getDefault__();
  config.method = "magic";
  EXPECT_THROW(fromConfig(config), std::invalid_argument);
}

/// What reading `key` with this value complains of; empty when it is taken.
std::string faultOf(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue values;
  values[key] = value;
  StrictParameters reader("/floor", values);
  FloorParameters parameters;
  readFloorParameters(reader, parameters);
  try {
    reader.finish();
  } catch (const ParameterFault& fault) {
    return fault.what();
  }
  return "";
}

TEST(FloorSettings, EveryKeyRefusesTextNanAndWhatIsOutOfRangeNamingItself) {
  const auto low = numbersOf(FloorConfig::__getMin__());
  const auto high = numbersOf(FloorConfig::__getMax__());
  for (const auto& entry : low) {
    const std::string& key = entry.first;
    const bool is_int = key == "min_points";
    const auto number = [is_int](double value) {
      return is_int ? XmlRpc::XmlRpcValue(static_cast<int>(value)) : XmlRpc::XmlRpcValue(value);
    };
    const std::string begin = "/floor: " + key + " is ";
    for (const auto& bad : {XmlRpc::XmlRpcValue("much"), XmlRpc::XmlRpcValue(true),
                            XmlRpc::XmlRpcValue(std::numeric_limits<double>::quiet_NaN()),
                            number(entry.second - 1.0), number(high.at(key) + 1.0)}) {
      const std::string fault = faultOf(key, bad);
      EXPECT_EQ(fault.rfind(begin, 0), 0U) << key << ": " << fault;
      EXPECT_NE(fault.find("expected a"), std::string::npos) << fault;
      EXPECT_NE(fault.find(" from "), std::string::npos) << "no range: " << fault;
    }
    EXPECT_NE(faultOf(key + "s", number(entry.second)).find(key + "s is not a parameter"),
              std::string::npos);
  }
  EXPECT_EQ(faultOf("method", "magic"),
            "/floor: method is \"magic\" (a string), expected one of original improved");
  EXPECT_EQ(faultOf("calibrate_mounting", 1),
            "/floor: calibrate_mounting is 1 (an int), expected true or false");
}

TEST(FloorSettings, AWrongCombinationIsRefused) {
  EXPECT_NE(faultOf("threshold_deviation", 0.4).find("obstacle_deviation is 0.015"),
            std::string::npos);
}

}  // namespace
}  // namespace pilothouse
