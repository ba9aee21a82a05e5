#include "core/floor/binner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace pilothouse {
namespace {

constexpr BinningKernel kVectorKernels[] = {BinningKernel::kSse4, BinningKernel::kAvx2};

struct CloudLayout {
  std::uint32_t step, x, y, z, row_padding, shift;  ///< bytes; shift: of the first byte in memory
};

/// A cloud in any layout. Its bytes end with its last point, so that a sanitizer sees a read
/// beyond.
struct TestCloud {
  TestCloud(const std::vector<Eigen::Vector3f>& points, std::uint32_t width, const CloudLayout& l) {
    const auto height = static_cast<std::uint32_t>(points.size() / width);
    const std::uint32_t row_step = width * l.step + l.row_padding;
    const std::size_t size = std::size_t{row_step} * height;
    bytes.assign(l.shift + size, 0xFF);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::uint8_t* p = bytes.data() + l.shift + i / width * row_step + i % width * l.step;
      std::memcpy(p + l.x, &points[i].x(), 4);
      std::memcpy(p + l.y, &points[i].y(), 4);
      std::memcpy(p + l.z, &points[i].z(), 4);
    }
    const CloudField fields[] = {{"x", l.x, 7, 1}, {"y", l.y, 7, 1}, {"z", l.z, 7, 1}};
    auto opened = CloudView::open(
        {width, height, l.step, row_step, false, fields, 3, bytes.data() + l.shift, size});
    EXPECT_TRUE(opened) << opened.reason();
    view = *opened;
  }
  std::vector<std::uint8_t> bytes;
  CloudView view;
};

struct TestDepth {
  template <class Pixel>
  TestDepth(const std::vector<Pixel>& pixels, std::uint32_t width, std::uint32_t padding,
            const Intrinsics& intrinsics) {
    const auto height = static_cast<std::uint32_t>(pixels.size() / width);
    const auto step = static_cast<std::uint32_t>(width * sizeof(Pixel) + padding);
    bytes.assign(std::size_t{step} * height, 0xFF);
    for (std::uint32_t v = 0; v < height; ++v) {
      std::memcpy(bytes.data() + std::size_t{v} * step, pixels.data() + std::size_t{v} * width,
                  width * sizeof(Pixel));
    }
    auto opened = DepthView::open({width, height, step, sizeof(Pixel) == 2 ? "16UC1" : "32FC1",
                                   false, bytes.data(), bytes.size(), width, height, intrinsics});
    EXPECT_TRUE(opened) << opened.reason();
    view = *opened;
  }
  std::vector<std::uint8_t> bytes;
  DepthView view;
};

class BinnerTest : public ::testing::Test {
 protected:
  float uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }

  /// Camera at a sensible or a wild place, looking anywhere.
  Eigen::Isometry3f mounting() {
    Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
    T.linear() = (Eigen::AngleAxisf(uniform(-3.1F, 3.1F), Eigen::Vector3f::UnitZ()) *
                  Eigen::AngleAxisf(uniform(-1.5F, 1.5F), Eigen::Vector3f::UnitY()) *
                  Eigen::AngleAxisf(uniform(-3.1F, 3.1F), Eigen::Vector3f::UnitX()))
                     .toRotationMatrix();
    T.translation() = Eigen::Vector3f(uniform(-2, 2), uniform(-2, 2), uniform(-1, 2));
    return T;
  }

  void setRandomGrid() {
    geometry.cell_size = uniform(0.01F, 0.3F);
    geometry.size_x = integer(1, 120);
    geometry.size_y = integer(1, 120);
    geometry.x_min = uniform(-3, 1);
    geometry.y_min = uniform(-3, 1);
    scale.low = uniform(-2.0F, -0.05F);
    scale.high = uniform(0.05F, 3.0F);
    scale.step = uniform(0.0005F, 0.003F);
  }

  /// Points around the grid, with every kind that a broken sensor sends among them.
  std::vector<Eigen::Vector3f> points(std::size_t count) {
    constexpr float kOdd[] = {std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::max(),
                              std::numeric_limits<float>::denorm_min(),
                              1e30F,
                              -1e30F,
                              2147483648.0F,
                              -2147483648.0F,
                              40000.0F,
                              -40000.0F,
                              0.0F,
                              -0.0F};
    std::vector<Eigen::Vector3f> result(count);
    for (auto& p : result) {
      p = Eigen::Vector3f(uniform(-4, 4), uniform(-4, 4), uniform(-4, 4));
      for (int axis = 0; axis < 3; ++axis) {
        if (integer(0, 15) == 0) p[axis] = kOdd[integer(0, std::size(kOdd) - 1)];
      }
    }
    return result;
  }

  template <class View>
  std::vector<CellMoments> sums(BinningKernel kernel, const View& view,
                                const Eigen::Isometry3f& T) {
    binner.configure(geometry, scale);
    binner.useKernel(kernel);
    EXPECT_EQ(binner.kernel(), kernel);
    binner.bin(view, T);
    return binner.bin(view, T);  // the second frame must not see the first
  }

  template <class View>
  void expectAllKernelsAgree(const View& view, const Eigen::Isometry3f& T) {
    const auto expected = sums(BinningKernel::kReference, view, T);
    for (const BinningKernel kernel : kVectorKernels) {
      if (!isSupported(kernel)) continue;
      EXPECT_EQ(differences(expected, sums(kernel, view, T)), 0)
          << "kernel " << static_cast<int>(kernel);
    }
  }

  static int differences(const std::vector<CellMoments>& a, const std::vector<CellMoments>& b) {
    if (a.size() != b.size()) return -1;
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      count +=
          a[i].count != b[i].count || a[i].sum != b[i].sum || a[i].sum_square != b[i].sum_square;
    }
    return count;
  }

  static std::uint64_t total(const std::vector<CellMoments>& cells) {
    std::uint64_t count = 0;
    for (const CellMoments& cell : cells) count += cell.count;
    return count;
  }

  std::mt19937 random{20140601};
  GridGeometry geometry{0.2F, -2.5F, 0.05F, 76, 100};
  HeightScale scale;
  Binner binner;
};

constexpr CloudLayout kLayouts[] = {
    {12, 0, 4, 8, 0, 0},  {12, 0, 4, 8, 5, 1},    {16, 0, 4, 8, 0, 0},    {16, 4, 8, 12, 0, 3},
    {16, 0, 4, 8, 48, 0}, {16, 8, 0, 4, 0, 0},    {20, 0, 4, 8, 0, 0},    {20, 5, 9, 13, 7, 1},
    {32, 0, 4, 8, 0, 0},  {32, 16, 20, 24, 0, 2}, {32, 20, 24, 28, 0, 0}, {32, 0, 12, 27, 3, 0},
    {13, 1, 5, 9, 0, 0},  {48, 0, 4, 8, 0, 0},
};

TEST_F(BinnerTest, EveryKernelGivesTheSumsOfTheReferenceForEveryCloudLayout) {
  for (const CloudLayout& layout : kLayouts) {
    for (const std::uint32_t width : {1U, 7U, 8U, 64U, 65U, 331U}) {
      setRandomGrid();
      const TestCloud cloud(points(std::size_t{width} * 9), width, layout);
      SCOPED_TRACE(testing::Message() << "step " << layout.step << " x at " << layout.x
                                      << " padding " << layout.row_padding << " width " << width);
      expectAllKernelsAgree(cloud.view, mounting());
    }
  }
}

TEST_F(BinnerTest, EveryKernelGivesTheSumsOfTheReferenceForDepthImages) {
  for (const std::uint32_t width : {1U, 3U, 8U, 17U, 160U, 333U}) {
    for (int repeat = 0; repeat < 8; ++repeat) {
      setRandomGrid();
      const Intrinsics intrinsics{uniform(50, 600), uniform(50, 600), uniform(0, 300),
                                  uniform(0, 200)};
      const Eigen::Isometry3f T = mounting();
      std::vector<std::uint16_t> millimetres(width * 60);
      for (auto& z : millimetres) {
        z = static_cast<std::uint16_t>(integer(0, 9) == 0 ? 65535 * integer(0, 1)
                                                          : integer(200, 6000));
      }
      std::vector<float> metres(millimetres.size());
      const auto odd = points(millimetres.size());
      for (std::size_t i = 0; i < metres.size(); ++i) metres[i] = odd[i].z();
      SCOPED_TRACE(testing::Message() << "width " << width);
      expectAllKernelsAgree(TestDepth(millimetres, width, 0, intrinsics).view, T);
      expectAllKernelsAgree(TestDepth(millimetres, width, 6, intrinsics).view, T);
      expectAllKernelsAgree(TestDepth(metres, width, 0, intrinsics).view, T);
      expectAllKernelsAgree(TestDepth(metres, width, 12, intrinsics).view, T);
    }
  }
}

TEST_F(BinnerTest, ManyPointsInOneCellDoNotOverflow) {
  // The largest cloud that the doors let in, every point in the same cell at the greatest height.
  scale = {-2.595F, 1.6F, 0.001F};
  const std::uint32_t count = 1U << 22;
  const TestCloud cloud(std::vector<Eigen::Vector3f>(count, {1.0F, 0.01F, 1.5F}), count,
                        {12, 0, 4, 8, 0, 0});
  for (const BinningKernel kernel :
       {BinningKernel::kReference, BinningKernel::kSse4, BinningKernel::kAvx2}) {
    if (!isSupported(kernel)) continue;
    const auto cells = sums(kernel, cloud.view, Eigen::Isometry3f::Identity());
    const CellMoments& cell = cells[geometry.index(16, 50)];
    EXPECT_EQ(cell.count, count);
    EXPECT_EQ(cell.sum, std::uint64_t{count} * HeightScale::kMaxStep);
    EXPECT_EQ(cell.sum_square,
              std::uint64_t{count} * HeightScale::kMaxStep * HeightScale::kMaxStep);
  }
}

TEST_F(BinnerTest, OrderOfThePointsDoesNotMatter) {
  auto cloud = points(20000);
  const Eigen::Isometry3f T = mounting();
  const CloudLayout layout{16, 0, 4, 8, 0, 0};
  const auto expected = sums(fastestKernel(), TestCloud(cloud, 20000, layout).view, T);
  EXPECT_GT(total(expected), 0U);
  std::shuffle(cloud.begin(), cloud.end(), random);
  EXPECT_EQ(differences(expected, sums(fastestKernel(), TestCloud(cloud, 20000, layout).view, T)),
            0);
}

TEST_F(BinnerTest, CountsAndHeightsAreThoseOfExactArithmetic) {
  // Points nearer than this to a border may fall on either side of it.
  constexpr double kBorder = 0.0001;
  for (int repeat = 0; repeat < 20; ++repeat) {
    setRandomGrid();
    const Eigen::Isometry3f T = mounting();
    std::vector<Eigen::Vector3f> clear;
    std::vector<std::uint64_t> counts(geometry.cells());
    std::vector<double> heights(geometry.cells());
    for (const Eigen::Vector3f& p : points(20000)) {
      const Eigen::Vector3d q = T.cast<double>() * p.cast<double>();
      const double gx = (q.x() - static_cast<double>(geometry.x_min)) / geometry.cell_size;
      const double gy = (q.y() - static_cast<double>(geometry.y_min)) / geometry.cell_size;
      const double border = kBorder / geometry.cell_size;
      if (std::abs(gx - std::round(gx)) < border || std::abs(gy - std::round(gy)) < border ||
          std::abs(q.z() - static_cast<double>(scale.high)) < kBorder) {
        continue;
      }
      clear.push_back(p);
      if (!q.allFinite() || q.z() > static_cast<double>(scale.high)) continue;
      if (!(gx >= 0 && gx < geometry.size_x && gy >= 0 && gy < geometry.size_y)) continue;
      const auto i = geometry.index(static_cast<int>(gx), static_cast<int>(gy));
      const double top =
          static_cast<double>(scale.low) + HeightScale::kMaxStep * static_cast<double>(scale.step);
      ++counts[i];
      heights[i] += std::clamp(q.z(), static_cast<double>(scale.low), top);
    }
    const auto width = static_cast<std::uint32_t>(clear.size());
    const auto cells = sums(fastestKernel(), TestCloud(clear, width, {16, 0, 4, 8, 0, 0}).view, T);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ASSERT_EQ(cells[i].count, counts[i]) << "cell " << i;
      if (counts[i] == 0) continue;
      const auto n = static_cast<double>(counts[i]);
      const double mean = static_cast<double>(scale.low) +
                          static_cast<double>(scale.step) * static_cast<double>(cells[i].sum) / n;
      EXPECT_NEAR(mean, heights[i] / n, 0.5 * static_cast<double>(scale.step) + kBorder);
    }
  }
}

TEST_F(BinnerTest, DepthAndItsCloudGiveTheSameSumsUpToRounding) {
  const Intrinsics k{525, 525, 319.5, 239.5};
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  Eigen::Matrix3f optical;
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.linear() = Eigen::AngleAxisf(0.45F, Eigen::Vector3f::UnitY()) * optical;
  T.translation() = Eigen::Vector3f(0.15F, 0, 0.65F);
  std::vector<std::uint16_t> depth(640 * 480);
  std::vector<Eigen::Vector3f> cloud(depth.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i] = static_cast<std::uint16_t>(integer(0, 5000));
    const float z = depth[i] > 0 ? 0.001F * static_cast<float>(depth[i]) : std::nanf("");
    cloud[i] = Eigen::Vector3f((static_cast<float>(i % 640) - 319.5F) / 525 * z,
                               (static_cast<float>(i / 640) - 239.5F) / 525 * z, z);
  }
  const auto from_depth = sums(fastestKernel(), TestDepth(depth, 640, 0, k).view, T);
  const auto from_cloud = sums(fastestKernel(), TestCloud(cloud, 640, {16, 0, 4, 8, 0, 0}).view, T);
  EXPECT_GT(total(from_depth), 50000U);
  std::uint64_t moved = 0;
  for (std::size_t i = 0; i < from_depth.size(); ++i) {
    moved += static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(from_depth[i].count) -
                                                 static_cast<std::int64_t>(from_cloud[i].count)));
  }
  EXPECT_LT(moved, total(from_depth) / 1000);
}

TEST_F(BinnerTest, GridsBeyondTheVectorKernelsGoThroughTheReference) {
  geometry = {-10.0F, -10.0F, 0.02F, 1000, 1000};
  const auto cloud = TestCloud(points(5000), 5000, {16, 0, 4, 8, 0, 0});
  ASSERT_GT(geometry.cells(), Binner::kMaxVectorCells);
  const Eigen::Isometry3f T = mounting();
  EXPECT_GT(total(sums(BinningKernel::kReference, cloud.view, T)), 2000U);
  expectAllKernelsAgree(cloud.view, T);
}

TEST(BinningKernels, TheFastestIsSupported) {
  EXPECT_TRUE(isSupported(BinningKernel::kReference));
  EXPECT_TRUE(isSupported(fastestKernel()));
#if defined(__x86_64__)
  // Every processor of the last fifteen years.
  EXPECT_NE(fastestKernel(), BinningKernel::kReference);
#endif
}

}  // namespace
}  // namespace pilothouse
