// A laser's scan made of a depth picture: how well it measures, and what it leaves out.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/floor/level_scan.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr double kFocal = 131.0;

Eigen::Isometry3f mounting() {
  // 0.65 m high, looking down by 26 degrees; optical: x right, y down, z forward.
  Eigen::Matrix3f optical;
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3f T_base_optical = Eigen::Isometry3f::Identity();
  T_base_optical.translate(Eigen::Vector3f(0.1F, 0.0F, 0.65F));
  T_base_optical.rotate(Eigen::AngleAxisf(0.454F, Eigen::Vector3f::UnitY()));
  T_base_optical.rotate(optical);
  return T_base_optical;
}

/// A floor, a wall across the way and before it, on the left, something low.
struct Picture {
  std::vector<float> metres = std::vector<float>(kWidth * kHeight, NAN);

  Picture(float wall, float low_height, double noise) {
    sim::Random random(1);
    const Eigen::Isometry3f T_base_optical = mounting();
    for (std::uint32_t row = 0; row < kHeight; ++row) {
      for (std::uint32_t col = 0; col < kWidth; ++col) {
        const Eigen::Vector3f ray(static_cast<float>((col - 79.5) / kFocal),
                                  static_cast<float>((row - 59.5) / kFocal), 1.0F);
        const Eigen::Vector3f from = T_base_optical.translation();
        const Eigen::Vector3f way = T_base_optical.linear() * ray;
        float depth = (wall - from.x()) / way.x();
        if (way.z() < 0.0F) depth = std::min(depth, -from.z() / way.z());
        const float low = (0.5F * wall - from.x()) / way.x();
        const Eigen::Vector3f there = from + low * way;
        if (there.y() > 0.0F && there.z() > 0.0F && there.z() < low_height) depth = low;
        metres[row * kWidth + col] = depth + static_cast<float>(noise * random.normal());
      }
    }
  }
  /// The same as points.
  std::vector<float> points() const {
    std::vector<float> points;
    for (std::uint32_t row = 0; row < kHeight; ++row) {
      for (std::uint32_t col = 0; col < kWidth; ++col) {
        const float z = metres[row * kWidth + col];
        points.push_back(static_cast<float>((col - 79.5) / kFocal) * z);
        points.push_back(static_cast<float>((row - 59.5) / kFocal) * z);
        points.push_back(z);
      }
    }
    return points;
  }
  DepthView view() const {
    DepthBytes bytes{};
    bytes.width = bytes.info_width = kWidth;
    bytes.height = bytes.info_height = kHeight;
    bytes.step = kWidth * 4;
    bytes.encoding = "32FC1";
    bytes.data = reinterpret_cast<const std::uint8_t*>(metres.data());
    bytes.size = metres.size() * 4;
    bytes.intrinsics = {kFocal, kFocal, 79.5, 59.5};
    return *DepthView::open(bytes);
  }
};

float rangeAt(const LevelScan& scan, const std::vector<float>& ranges, float bearing) {
  const float beam = (bearing - scan.geometry().angle_min) / scan.geometry().increment;
  return ranges[static_cast<std::size_t>(std::lround(beam))];
}

TEST(LevelScan, MeasuresAWallBetterThanAPixelDoes) {
  LevelScan scan;
  const Picture picture(2.0F, 0.0F, 0.01);
  const auto& ranges = scan.scan(picture.view(), mounting());
  double squares = 0.0;
  int beams = 0;
  for (float bearing = -0.4F; bearing <= 0.4F; bearing += 0.01F) {
    const float range = rangeAt(scan, ranges, bearing);
    if (!std::isfinite(range)) continue;
    const double off = range * std::cos(bearing) - 2.0;
    squares += off * off;
    ++beams;
  }
  EXPECT_GT(beams, 50);
  EXPECT_LT(std::sqrt(squares / beams), 0.006);
  EXPECT_TRUE(std::isnan(rangeAt(scan, ranges, 1.2F))) << "not in view";
}

TEST(LevelScan, LeavesOutTheFloorAndWhatIsLowAndTellsTheNearest) {
  LevelScan scan;
  const Picture low(2.0F, 0.08F, 0.0), high(2.0F, 0.3F, 0.0), far(7.0F, 0.0F, 0.0);
  const auto left = [&scan](const Picture& picture) {
    return rangeAt(scan, scan.scan(picture.view(), mounting()), 0.2F) * std::cos(0.2F);
  };
  EXPECT_NEAR(left(low), 2.0, 0.01);
  EXPECT_NEAR(left(high), 1.0, 0.01);
  EXPECT_TRUE(std::isnan(left(far))) << "nothing but floor within reach";
  EXPECT_NEAR(left(low), 2.0, 0.01) << "nothing of the frame before stays";
}

TEST(LevelScan, IsTheSameOfACloudAsOfAPicture) {
  LevelScan of_picture, of_cloud;
  const Picture picture(2.0F, 0.3F, 0.01);
  const std::vector<float> points = picture.points();
  const CloudField fields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
  const auto cloud =
      CloudView::open({kWidth, kHeight, 12, kWidth * 12, false, fields, 3,
                       reinterpret_cast<const std::uint8_t*>(points.data()), points.size() * 4});
  ASSERT_TRUE(cloud) << cloud.reason();
  const auto& one = of_picture.scan(picture.view(), mounting());
  const auto& other = of_cloud.scan(*cloud, mounting());
  int measured = 0, alike = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(std::isnan(one[i]), std::isnan(other[i])) << "beam " << i;
    if (std::isnan(one[i])) continue;
    ++measured;
    if (std::abs(one[i] - other[i]) < 1e-4F) ++alike;
  }
  EXPECT_GT(measured, 100);
  // The last bit of a coordinate may put a point on the other side of a limit.
  EXPECT_GT(alike, measured * 9 / 10);
}

TEST(LevelScan, TellsNothingOfNoPictureOrOfAMountingThatIsNone) {
  LevelScan scan;
  const Picture picture(2.0F, 0.3F, 0.0);
  Eigen::Isometry3f nowhere = mounting();
  nowhere.translation().x() = NAN;
  for (const float range : scan.scan(picture.view(), nowhere)) EXPECT_TRUE(std::isnan(range));
  const CloudField fields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
  const auto empty = CloudView::open({0, 0, 12, 0, false, fields, 3, nullptr, 0});
  ASSERT_TRUE(empty) << empty.reason();
  for (const float range : scan.scan(*empty, mounting())) EXPECT_TRUE(std::isnan(range));
}

}  // namespace
}  // namespace pilothouse
