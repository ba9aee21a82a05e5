#include <gtest/gtest.h>

#include <limits>

#include "doors/strict_parameters.hpp"

namespace pilothouse {
namespace {

using XmlRpc::XmlRpcValue;

template <class T>
StrictParameters with(const char* key, T value) {
  XmlRpcValue values;
  values[key] = value;
  return StrictParameters("/n", values);
}

/// The one fault of reading `key` into a double of 0.5 to 2.
template <class T>
std::string faultOf(T value) {
  StrictParameters reader = with("range", value);
  double range = 1.0;
  reader.read("range", range, 0.5, 2.0);
  EXPECT_EQ(range, 1.0) << "a refused value must not be taken over";
  try {
    reader.finish();
  } catch (const ParameterFault& fault) {
    EXPECT_EQ(fault.faults().size(), 1U);
    return fault.what();
  }
  return "none";
}

TEST(StrictParameters, NamesKeyValueAndRangeOfEveryFault) {
  EXPECT_EQ(faultOf("far"), "/n: range is \"far\" (a string), expected a number from 0.5 to 2");
  EXPECT_EQ(faultOf(true), "/n: range is true (a bool), expected a number from 0.5 to 2");
  EXPECT_EQ(faultOf(2.5), "/n: range is 2.5 (a double), expected a number from 0.5 to 2");
  EXPECT_EQ(faultOf(-3), "/n: range is -3 (an int), expected a number from 0.5 to 2");
  EXPECT_EQ(faultOf(std::numeric_limits<double>::quiet_NaN()),
            "/n: range is nan (a double), expected a number from 0.5 to 2");
  EXPECT_EQ(faultOf(std::numeric_limits<double>::infinity()),
            "/n: range is inf (a double), expected a number from 0.5 to 2");
}

TEST(StrictParameters, AnIntIsANumber) {
  StrictParameters reader = with("range", 2);
  double range = 1.0;
  reader.read("range", range, 0.5, 2.0);
  EXPECT_NO_THROW(reader.finish());
  EXPECT_EQ(range, 2.0);
}

TEST(StrictParameters, ADoubleIsNoInt) {
  StrictParameters reader = with("count", 3.0);
  int count = 1;
  reader.read("count", count, 1, 10);
  EXPECT_THROW(reader.finish(), ParameterFault);
  EXPECT_EQ(count, 1);
}

TEST(StrictParameters, AnIntIsNoBoolAndATextIsNoBool) {
  for (const XmlRpcValue& value : {XmlRpcValue(1), XmlRpcValue("true")}) {
    StrictParameters reader = with("on", value);
    bool on = false;
    reader.read("on", on);
    EXPECT_THROW(reader.finish(), ParameterFault);
  }
}

TEST(StrictParameters, ATextMustBeOneOfThoseAllowed) {
  StrictParameters reader = with("method", "orignal");
  std::string method = "improved";
  reader.read("method", method, {"original", "improved"});
  EXPECT_EQ(method, "improved");
  try {
    reader.finish();
    FAIL();
  } catch (const ParameterFault& fault) {
    EXPECT_STREQ(fault.what(),
                 "/n: method is \"orignal\" (a string), expected one of original improved");
  }
}

TEST(StrictParameters, AKeyNobodyAskedForIsAFault) {
  StrictParameters reader = with("rnage", 2.0);
  double range = 1.0;
  reader.read("range", range, 0.5, 2.0);
  try {
    reader.finish();
    FAIL();
  } catch (const ParameterFault& fault) {
    EXPECT_STREQ(fault.what(), "/n: rnage is not a parameter here (value 2), expected only: range");
  }
}

TEST(StrictParameters, AMissingKeyKeepsTheDefaultUnlessRequired) {
  StrictParameters reader("/n", XmlRpcValue());
  double range = 1.0;
  reader.read("range", range, 0.5, 2.0);
  EXPECT_NO_THROW(reader.finish());
  EXPECT_EQ(range, 1.0);
  reader.require({"range"});
  EXPECT_THROW(reader.finish(), ParameterFault);
}

TEST(StrictParameters, AChildIsReadByTheSameRules) {
  XmlRpcValue values;
  values["camera"]["x"] = "left";
  values["camera"]["extra"] = 1;
  StrictParameters reader("/n", values);
  StrictParameters camera = reader.child("camera");
  double x = 0.0;
  camera.read("x", x, -1.0, 1.0);
  reader.merge(camera);
  try {
    reader.finish();
    FAIL();
  } catch (const ParameterFault& fault) {
    ASSERT_EQ(fault.faults().size(), 2U);
    EXPECT_EQ(fault.faults()[0],
              "/n/camera: x is \"left\" (a string), expected a number from -1 to 1");
    EXPECT_EQ(fault.faults()[1],
              "/n/camera: extra is not a parameter here (value 1), expected only: x");
  }
}

TEST(StrictParameters, AValueInPlaceOfANamespaceIsAFault) {
  StrictParameters reader("/n", XmlRpcValue(5));
  EXPECT_THROW(reader.finish(), ParameterFault);
}

}  // namespace
}  // namespace pilothouse
