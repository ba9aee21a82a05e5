#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/floor/point_gather.hpp"

namespace pilothouse {
namespace {

constexpr auto F = CellClass::kFloor, T = CellClass::kThreshold, O = CellClass::kObstacle,
               D = CellClass::kDropOff, U = CellClass::kUnknown;

class PointGather : public testing::Test {
 protected:
  static constexpr std::uint32_t kCols = 3, kRows = 2;
  PointGather() : points_(kCols * kRows * 4) {
    for (std::size_t i = 0; i < kCols * kRows; ++i) {
      const auto n = static_cast<float>(i);
      points_[4 * i] = n;
      points_[4 * i + 1] = 10.0F + n;
      points_[4 * i + 2] = 20.0F + n;
    }
  }
  CloudView cloud() const {
    static const CloudField fields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
    const CloudBytes bytes{kCols,
                           kRows,
                           16,
                           16 * kCols,
                           false,
                           fields,
                           3,
                           reinterpret_cast<const std::uint8_t*>(points_.data()),
                           points_.size() * sizeof(float)};
    const auto view = CloudView::open(bytes);
    EXPECT_TRUE(view) << view.reason();
    return *view;
  }
  static std::vector<float> floats(const std::vector<std::uint8_t>& bytes) {
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
  }
  std::vector<float> points_;
  std::vector<std::uint8_t> out_;
};

TEST_F(PointGather, TakesDrivablePointsForFloorAndTheOthersForObstacles) {
  const std::vector<CellClass> classes{F, T, O, D, U, F};
  gatherPoints(cloud(), classes, PointKind::kFloor, out_);
  EXPECT_EQ(floats(out_), (std::vector<float>{0, 10, 20, 1, 11, 21, 5, 15, 25}));
  gatherPoints(cloud(), classes, PointKind::kObstacle, out_);
  EXPECT_EQ(floats(out_), (std::vector<float>{2, 12, 22, 3, 13, 23}));
}

TEST_F(PointGather, GivesNothingWhereNothingIsKnown) {
  gatherPoints(cloud(), std::vector<CellClass>(6, U), PointKind::kFloor, out_);
  EXPECT_TRUE(out_.empty());
}

TEST_F(PointGather, RefusesClassesOfAnotherPicture) {
  EXPECT_THROW(gatherPoints(cloud(), std::vector<CellClass>(5, F), PointKind::kFloor, out_),
               std::invalid_argument);
}

TEST_F(PointGather, ProjectsADepthImageByItsIntrinsics) {
  const std::vector<std::uint16_t> depth{0, 2000};
  DepthBytes bytes{};
  bytes.width = bytes.info_width = 2;
  bytes.height = bytes.info_height = 1;
  bytes.step = 4;
  bytes.encoding = "16UC1";
  bytes.data = reinterpret_cast<const std::uint8_t*>(depth.data());
  bytes.size = 4;
  bytes.intrinsics = {100.0, 50.0, 0.5, 1.0};
  const auto view = DepthView::open(bytes);
  ASSERT_TRUE(view) << view.reason();
  gatherPoints(*view, {U, O}, PointKind::kObstacle, out_);
  const auto point = floats(out_);
  ASSERT_EQ(point.size(), 3U);
  EXPECT_FLOAT_EQ(point[0], 0.01F);
  EXPECT_FLOAT_EQ(point[1], -0.04F);
  EXPECT_FLOAT_EQ(point[2], 2.0F);
}

}  // namespace
}  // namespace pilothouse
