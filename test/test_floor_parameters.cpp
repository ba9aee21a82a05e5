#include <gtest/gtest.h>

#include <limits>

#include "core/floor/floor_parameters.hpp"
#include "core/floor/floor_segmenter.hpp"

namespace pilothouse {
namespace {

TEST(FloorParameters, DefaultsAreSound) {
  EXPECT_TRUE(validate(FloorParameters{}).empty());
}

TEST(FloorParameters, EachFaultNamesKeyValueAndRange) {
  FloorParameters p;
  p.cell_size = -1.0;
  p.range = std::numeric_limits<double>::quiet_NaN();
  const auto faults = validate(p);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0], "cell_size is -1, expected 0.01 to 0.5");
  EXPECT_EQ(faults[1], "range is nan, expected 0.5 to 20");
}

TEST(FloorParameters, LimitsMustNotCross) {
  FloorParameters p;
  p.threshold_deviation = 0.02;
  p.obstacle_deviation = 0.01;
  ASSERT_EQ(validate(p).size(), 1U);
  EXPECT_THROW(FloorSegmenter{p}, std::invalid_argument);
}

}  // namespace
}  // namespace pilothouse
