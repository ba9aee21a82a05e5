// A nodelet that is given bad parameters must not start, and must say which key, value and range.
#include <gtest/gtest.h>
#include <pilothouse/FloorConfig.h>
#include <rosgraph_msgs/Log.h>

#include <cmath>

#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

/// Everything logged as fatal in this process since the last call.
class FatalLog {
 public:
  FatalLog()
      : subscriber_(handle_.subscribe<rosgraph_msgs::Log>(
            "/rosout", 1000, [this](const rosgraph_msgs::Log::ConstPtr& log) {
              if (log->level == rosgraph_msgs::Log::FATAL) lines_.push_back(log->msg);
            })) {
    spinUntil([this] { return subscriber_.getNumPublishers() > 0; });
  }
  bool waitFor(const std::string& text) {
    return spinUntil([&] { return has(text); });
  }
  std::string all() const {
    std::string text;
    for (const auto& line : lines_) text += line + '\n';
    return text;
  }
  void clear() { lines_.clear(); }

 private:
  bool has(const std::string& text) const { return all().find(text) != std::string::npos; }
  ros::NodeHandle handle_;
  std::vector<std::string> lines_;
  ros::Subscriber subscriber_;
};

class Refusal : public testing::TestWithParam<std::string> {
 protected:
  /// Loads with one bad value; the log must name the key and what was expected.
  template <class T>
  void expectRefused(const std::string& key, const T& value, const std::string& expected) {
    FloorHarness harness(GetParam());
    harness.set("floor/" + key, value);
    log_.clear();
    EXPECT_FALSE(harness.load()) << key;
    const std::string line = "parameter " + harness.name() + ": " + key + " is ";
    EXPECT_TRUE(log_.waitFor(line)) << "no fatal line begins " << line << "; got " << log_.all();
    EXPECT_NE(log_.all().find(expected), std::string::npos) << log_.all();
  }
  FatalLog log_;
};

TEST_P(Refusal, OfEveryNumberThatIsATextNotANumberOrOutOfRange) {
  dynamic_reconfigure::Config low, high;
  FloorConfig::__getMin__().__toMessage__(low);
  FloorConfig::__getMax__().__toMessage__(high);
  for (std::size_t i = 0; i < low.doubles.size(); ++i) {
    const std::string& key = low.doubles[i].name;
    expectRefused(key, std::string("much"), "expected a number from");
    expectRefused(key, std::nan(""), "expected a number from");
    expectRefused(key, low.doubles[i].value - 1.0, "expected a number from");
    expectRefused(key, high.doubles[i].value + 1.0, "expected a number from");
  }
  for (std::size_t i = 0; i < low.ints.size(); ++i) {
    const std::string& key = low.ints[i].name;
    expectRefused(key, std::string("much"), "expected an int from");
    expectRefused(key, std::nan(""), "expected an int from");
    expectRefused(key, low.ints[i].value - 1, "expected an int from");
    expectRefused(key, high.ints[i].value + 1, "expected an int from");
  }
  expectRefused("input_timeout", std::string("long"), "expected a number from");
  expectRefused("input_timeout", -1.0, "expected a number from");
}

TEST_P(Refusal, OfTextsAndSwitches) {
  expectRefused("method", std::string("magic"), "expected one of original improved");
  expectRefused("method", 1, "expected one of original improved");
  expectRefused("mounting_source", std::string("guess"), "expected one of tf search");
  expectRefused("base_frame", std::string(), "expected a text");
  expectRefused("calibrate_mounting", 1, "expected true or false");
  expectRefused("calibrate_mounting", std::string("yes"), "expected true or false");
}

TEST_P(Refusal, OfUnknownKeys) {
  expectRefused("rnage", 2.0, "is not a parameter here (value 2), expected only:");
  expectRefused("Range", 2.0, "is not a parameter here");
}

TEST_P(Refusal, OfLimitsThatCross) {
  FloorHarness harness(GetParam());
  harness.set("floor/threshold_deviation", 0.3);
  log_.clear();
  EXPECT_FALSE(harness.load());
  EXPECT_TRUE(log_.waitFor("obstacle_deviation is 0.015, expected 0.3 to 0.5"));
}

TEST_P(Refusal, OfABadRobotsFile) {
  FloorHarness harness(GetParam());
  harness.set("robot/floor/range", -2.0);
  log_.clear();
  EXPECT_FALSE(harness.load());
  EXPECT_TRUE(log_.waitFor("/robot/floor: range is -2 (a double), expected a number from 0.5"));
}

TEST_P(Refusal, LeavesNothingBehindAndASecondTryWithGoodValuesStarts) {
  FloorHarness harness(GetParam());
  harness.set("floor/range", std::string("far"));
  EXPECT_FALSE(harness.load());
  harness.set("floor/range", 3);
  EXPECT_TRUE(harness.load()) << "an int is a number";
}

INSTANTIATE_TEST_SUITE_P(Both, Refusal, testing::Values("DepthFloor", "CloudFloor"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_refusals");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
