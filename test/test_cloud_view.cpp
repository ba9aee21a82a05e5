#include "core/cloud/cloud_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace pilothouse {
namespace {

constexpr std::uint32_t kMax32 = std::numeric_limits<std::uint32_t>::max();

/// A cloud whose every part can be spoilt. Points are (row, col, row + col).
class Cloud {
 public:
  explicit Cloud(std::uint32_t width = 4, std::uint32_t height = 3, std::uint32_t point_step = 16,
                 std::uint32_t padding = 0)
      : fields{{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"rgb", 12, 7, 1}},
        bytes{width, height,  point_step, width * point_step + padding, false, nullptr,
              0,     nullptr, 0} {
    // Exactly as large as needed: no padding after the last row, so that a step beyond is seen.
    data.resize((std::size_t{height} - 1) * bytes.row_step + std::size_t{width} * point_step);
  }
  void fill() {
    for (std::uint32_t row = 0; row < bytes.height; ++row)
      for (std::uint32_t col = 0; col < bytes.width; ++col) {
        const float xyz[3] = {static_cast<float>(row), static_cast<float>(col),
                              static_cast<float>(row + col)};
        std::uint8_t* point =
            &data[std::size_t{row} * bytes.row_step + std::size_t{col} * bytes.point_step];
        for (std::size_t axis = 0; axis < 3; ++axis)
          std::memcpy(point + fields[axis].offset, &xyz[axis], sizeof(float));
      }
  }
  Checked<CloudView> open(const CloudBounds& bounds = {}) {
    bytes.fields = fields.data();
    bytes.field_count = fields.size();
    bytes.data = data.data();
    bytes.size = data.size();
    return CloudView::open(bytes, bounds);
  }
  std::string reason() { return open().reason(); }

  std::vector<CloudField> fields;
  CloudBytes bytes;
  std::vector<std::uint8_t> data;
};

void expectEveryPoint(const CloudView& view) {
  for (std::uint32_t row = 0; row < view.height(); ++row)
    for (std::uint32_t col = 0; col < view.width(); ++col) {
      const Eigen::Vector3f expected(static_cast<float>(row), static_cast<float>(col),
                                     static_cast<float>(row + col));
      ASSERT_EQ(view.point(row, col), expected) << row << ' ' << col;
    }
}

TEST(CloudView, ReadsEveryPointOfAnOrganisedCloud) {
  Cloud cloud;
  cloud.fill();
  const auto view = cloud.open();
  ASSERT_TRUE(view) << view.reason();
  EXPECT_EQ(view->points(), 12U);
  expectEveryPoint(*view);
}

TEST(CloudView, ReadsAnyOffsetsStepsAndOrder) {
  for (const std::uint32_t point_step : {12U, 13U, 20U, 32U, 48U})
    for (const std::uint32_t padding : {0U, 1U, 64U}) {
      Cloud cloud(5, 4, point_step, padding);
      const std::uint32_t last = point_step - 4;
      cloud.fields = {{"x", last, 7, 1}, {"y", last - 4, 7, 0}, {"z", 0, 7, 1}};
      cloud.fill();
      std::reverse(cloud.fields.begin(), cloud.fields.end());
      const auto view = cloud.open();
      ASSERT_TRUE(view) << point_step << ": " << view.reason();
      expectEveryPoint(*view);
    }
}

TEST(CloudView, ReadsUnalignedData) {
  Cloud cloud;
  cloud.fill();
  cloud.open();
  auto shifted = std::make_unique<std::uint8_t[]>(cloud.data.size() + 1);
  std::memcpy(shifted.get() + 1, cloud.data.data(), cloud.data.size());
  cloud.bytes.data = shifted.get() + 1;
  const auto view = CloudView::open(cloud.bytes);
  ASSERT_TRUE(view) << view.reason();
  expectEveryPoint(*view);
}

TEST(CloudView, AcceptsCountZeroWhichMeansOne) {
  Cloud cloud;
  for (CloudField& field : cloud.fields) field.count = 0;
  EXPECT_TRUE(cloud.open());
}

TEST(CloudView, AnEmptyCloudIsAnEmptyView) {
  for (const auto& [width, height] : {std::pair{0U, 0U}, {0U, 1U}, {7U, 0U}, {0U, kMax32}}) {
    Cloud cloud;
    cloud.bytes.width = width;
    cloud.bytes.height = height;
    cloud.bytes.row_step = 0;
    cloud.data.clear();
    const auto view = cloud.open();
    ASSERT_TRUE(view) << view.reason();
    EXPECT_EQ(view->points(), 0U);
    EXPECT_EQ(view->width(), 0U);
    EXPECT_EQ(view->height(), 0U);
  }
}

TEST(CloudView, AnEmptyCloudStillNeedsItsFields) {
  Cloud cloud;
  cloud.bytes.width = 0;
  cloud.fields.clear();
  EXPECT_EQ(cloud.reason(), "cloud field x is missing, expected float32");
}

TEST(CloudView, RefusesDataTooShort) {
  Cloud cloud;
  cloud.data.pop_back();
  EXPECT_EQ(cloud.reason(), "cloud data is 191, expected at least 192 bytes");
  cloud.data.clear();
  EXPECT_EQ(cloud.reason(), "cloud data is 0, expected at least 192 bytes");
}

TEST(CloudView, RefusesABadFieldOffset) {
  Cloud cloud;
  for (const std::uint32_t offset : {13U, 16U, 1U << 30U, kMax32 - 3, kMax32}) {
    cloud.fields[1].offset = offset;
    EXPECT_EQ(cloud.reason(), "cloud field y offset is " + std::to_string(offset) +
                                  ", expected 4 bytes inside the point_step of 16");
  }
}

TEST(CloudView, RefusesAWrongRowStep) {
  Cloud cloud;
  for (const std::uint32_t step : {0U, 1U, 63U}) {
    cloud.bytes.row_step = step;
    EXPECT_EQ(cloud.reason(), "cloud row_step is " + std::to_string(step) +
                                  ", expected at least width * point_step = 64 bytes");
  }
  cloud.bytes.row_step = kMax32;
  EXPECT_EQ(cloud.reason(), "cloud data is 192, expected at least 8589934654 bytes");
}

TEST(CloudView, RefusesWidthAndHeightThatWouldHang) {
  Cloud cloud;
  cloud.bytes.width = cloud.bytes.height = kMax32;
  EXPECT_EQ(cloud.reason(),
            "cloud size is 4294967295 x 4294967295, expected at most 4194304 points");
  cloud.bytes.width = 1U << 16U;  // their product is 0 in 32 bits
  cloud.bytes.height = 1U << 16U;
  EXPECT_EQ(cloud.reason(), "cloud size is 65536 x 65536, expected at most 4194304 points");
}

TEST(CloudView, RefusesStepsWhoseProductOverflows32Bits) {
  Cloud cloud;
  cloud.bytes.width = 4;
  cloud.bytes.height = 1;
  cloud.bytes.point_step = 0x40000000U;  // 4 * 2^30 is 0 in 32 bits
  cloud.bytes.row_step = 0;
  EXPECT_EQ(cloud.reason(),
            "cloud row_step is 0, expected at least width * point_step = 4294967296 bytes");
}

TEST(CloudView, RefusesACloudWithoutXyz) {
  for (const std::size_t missing : {0U, 1U, 2U}) {
    Cloud cloud;
    cloud.fields[missing].name = "intensity";
    const std::string axis(1, static_cast<char>('x' + static_cast<int>(missing)));
    EXPECT_EQ(cloud.reason(), "cloud field " + axis + " is missing, expected float32");
  }
  Cloud bare;
  bare.fields.clear();
  EXPECT_EQ(bare.reason(), "cloud field x is missing, expected float32");
}

TEST(CloudView, RefusesAFieldThatIsThereTwice) {
  Cloud cloud;
  cloud.fields[3].name = "x";
  EXPECT_EQ(cloud.reason(), "cloud field x is there twice, expected once");
}

TEST(CloudView, RefusesOtherTypesAndCounts) {
  for (const int datatype : {0, 1, 6, 8, 9, 255}) {
    Cloud cloud;
    cloud.fields[2].datatype = static_cast<std::uint8_t>(datatype);
    EXPECT_EQ(cloud.reason(),
              "cloud field z datatype is " + std::to_string(datatype) + ", expected 7 (float32)");
  }
  Cloud cloud;
  cloud.fields[0].count = 3;
  EXPECT_EQ(cloud.reason(), "cloud field x count is 3, expected 1");
}

TEST(CloudView, RefusesAxesThatOverlap) {
  Cloud cloud;
  cloud.fields[2].offset = 6;
  EXPECT_EQ(cloud.reason(), "cloud field z offset is 6, expected no overlap with field y at 4");
}

TEST(CloudView, RefusesBigEndian) {
  Cloud cloud;
  cloud.bytes.is_bigendian = true;
  EXPECT_EQ(cloud.reason(), "cloud is_bigendian is true, expected false");
}

TEST(CloudView, RefusesPointStepZero) {
  Cloud cloud;
  cloud.bytes.point_step = 0;
  EXPECT_EQ(cloud.reason(), "cloud point_step is 0, expected 12 or more");
}

TEST(CloudView, RefusesNullPointers) {
  Cloud cloud;
  cloud.open();
  CloudBytes bytes = cloud.bytes;
  bytes.data = nullptr;
  EXPECT_EQ(CloudView::open(bytes).reason(), "cloud data is null, expected bytes");
  bytes.size = 0;
  EXPECT_EQ(CloudView::open(bytes).reason(), "cloud data is 0, expected at least 192 bytes");
  bytes = cloud.bytes;
  bytes.fields = nullptr;
  EXPECT_EQ(CloudView::open(bytes).reason(), "cloud fields is null, expected x y z");
}

TEST(CloudView, RefusesWhatExceedsItsBounds) {
  Cloud cloud;
  CloudBounds bounds;
  bounds.max_points = 11;
  EXPECT_EQ(cloud.open(bounds).reason(), "cloud size is 4 x 3, expected at most 11 points");
  bounds = CloudBounds{};
  bounds.max_bytes = 191;
  EXPECT_EQ(cloud.open(bounds).reason(), "cloud data is 192, expected at most 191 bytes");
  bounds = CloudBounds{};
  bounds.max_fields = 3;
  EXPECT_EQ(cloud.open(bounds).reason(), "cloud fields is 4, expected at most 3");
}

}  // namespace
}  // namespace pilothouse
