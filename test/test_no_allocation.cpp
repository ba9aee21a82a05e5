// The hot path allocates nothing after its first frame: every operator new is counted.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

#include "core/floor/floor_segmenter.hpp"
#include "core/floor/level_scan.hpp"
#include "core/floor/nearest_objects.hpp"
#include "core/floor/virtual_scan.hpp"
#include "core/mapping/occupancy_map.hpp"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* memory = nullptr;
  if (posix_memalign(&memory, alignment < sizeof(void*) ? sizeof(void*) : alignment, size) != 0) {
    throw std::bad_alloc();
  }
  return memory;
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new[](std::size_t size) {
  return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace pilothouse {
namespace {

class NoAllocationTest : public ::testing::TestWithParam<BinningKernel> {
 protected:
  static constexpr std::uint32_t kWidth = 320, kHeight = 240;

  NoAllocationTest() : depth(kWidth * kHeight), points(depth.size() * 4) {
    Eigen::Matrix3f optical;
    optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    T_base_optical.linear() = Eigen::AngleAxisf(0.45F, Eigen::Vector3f::UnitY()) * optical;
    T_base_optical.translation() = Eigen::Vector3f(0.15F, 0, 0.65F);
  }

  /// A floor with a block on it that moves on from frame to frame, and a hole beside it.
  void render(int frame) {
    for (std::uint32_t v = 0; v < kHeight; ++v) {
      for (std::uint32_t u = 0; u < kWidth; ++u) {
        const Eigen::Vector3f ray((static_cast<float>(u) - 159.5F) / 262,
                                  (static_cast<float>(v) - 119.5F) / 262, 1.0F);
        const float down = (T_base_optical.linear() * ray).z();
        float z = down < -0.1F ? -0.65F / down : 6.0F;
        const auto block = static_cast<std::uint32_t>(20 + frame * 3);
        if (v > 100 && v < 140 && u > block && u < block + 60) z *= 0.8F;
        if (v > 60 && v < 90 && u > 200) z *= 1.3F;
        if ((u * 7 + v * 13) % 97 == 0) z = 0.0F;
        const std::size_t i = std::size_t{v} * kWidth + u;
        depth[i] = static_cast<std::uint16_t>(1000.0F * z);
        const float measured = z > 0.0F ? z : std::nanf("");
        for (int axis = 0; axis < 3; ++axis) points[4 * i + axis] = ray[axis] * measured;
      }
    }
  }

  CloudView cloud() const {
    static const CloudField fields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
    return *CloudView::open({kWidth, kHeight, 16, kWidth * 16, false, fields, 3,
                             reinterpret_cast<const std::uint8_t*>(points.data()),
                             points.size() * sizeof(float)});
  }
  DepthView image() const {
    return *DepthView::open({kWidth,
                             kHeight,
                             kWidth * 2,
                             "16UC1",
                             false,
                             reinterpret_cast<const std::uint8_t*>(depth.data()),
                             depth.size() * 2,
                             kWidth,
                             kHeight,
                             {262, 262, 159.5, 119.5}});
  }

  /// Allocations of `segment` over frames 3 to 10.
  template <class Segment>
  long allocationsOf(const Segment& segment) {
    long count = 0;
    for (int frame = 0; frame < 10; ++frame) {
      render(frame);
      const long before = allocations;
      segment();
      if (frame >= 2) count += allocations - before;
    }
    return count;
  }

  std::vector<std::uint16_t> depth;
  std::vector<float> points;
  Eigen::Isometry3f T_base_optical = Eigen::Isometry3f::Identity();
};

TEST_P(NoAllocationTest, SegmentingAllocatesNothingAfterTheFirstFrames) {
  if (!isSupported(GetParam())) GTEST_SKIP() << "this processor lacks the kernel";
  for (const FloorMethod method : {FloorMethod::kOriginal, FloorMethod::kImproved}) {
    FloorParameters parameters;
    parameters.method = method;
    parameters.calibrate_mounting = true;
    FloorSegmenter segmenter(parameters);
    segmenter.useKernel(GetParam());
    const CloudView cloud_view = cloud();
    const DepthView depth_view = image();
    EXPECT_EQ(allocationsOf([&] { segmenter.segment(cloud_view, T_base_optical); }), 0);
    EXPECT_EQ(allocationsOf([&] { segmenter.segment(depth_view, T_base_optical); }), 0);
  }
}

TEST_F(NoAllocationTest, MeasuringALevelScanAllocatesNothingAfterTheFirstFrames) {
  LevelScan scan;
  const CloudView cloud_view = cloud();
  const DepthView depth_view = image();
  EXPECT_EQ(allocationsOf([&] { scan.scan(cloud_view, T_base_optical); }), 0);
  EXPECT_EQ(allocationsOf([&] { scan.scan(depth_view, T_base_optical); }), 0);
}

TEST_F(NoAllocationTest, ListingObjectsAndScanningAllocateNothingAfterTheFirstFrames) {
  FloorCells grid;
  grid.geometry = {0.2F, -2.5F, 0.05F, 76, 100};
  NearestObjects nearest;
  VirtualScan scan;
  int frame = 0;
  const auto work = [&] {  // ever more objects: room for all must be there from the beginning
    for (std::size_t i = 0; i < grid.classes.size(); ++i) {
      grid.classes[i] =
          i % 10 < static_cast<std::size_t>(frame) ? CellClass::kObstacle : CellClass::kFloor;
    }
    ++frame;
    nearest.find(grid);
    scan.scan(grid);
  };
  grid.classes.assign(grid.geometry.cells(), CellClass::kFloor);
  EXPECT_EQ(allocationsOf(work), 0);
  EXPECT_FALSE(nearest.find(grid).empty());
}

TEST_F(NoAllocationTest, LearningTheMapAllocatesNothingOnceItHasGrown) {
  FloorCells grid;
  grid.geometry = {0.2F, -2.5F, 0.05F, 76, 100};
  grid.classes.assign(grid.geometry.cells(), CellClass::kFloor);
  for (std::size_t i = 0; i < grid.classes.size(); i += 7) grid.classes[i] = CellClass::kDropOff;
  const FloorFrame floor{0.0, grid.geometry, grid.classes.data(), nullptr};
  const std::vector<float> ranges(640, 3.0F);
  PlanarScan scan;
  scan.increment = 2.0 * M_PI / 640.0;
  scan.range_max = 10.0;
  scan.ranges = ranges.data();
  scan.count = ranges.size();
  OccupancyMap map({});
  int frame = 0;
  const auto work = [&] {  // ten places, again and again
    const Pose2 pose{0.1 * (frame % 10), 0.0, 0.3 * (frame % 10)};
    ++frame;
    map.addFloor(floor, pose);
    map.addScan(scan, pose);
  };
  for (int i = 0; i < 10; ++i) work();
  EXPECT_EQ(allocationsOf(work), 0);
  EXPECT_GT(map.blockCount(), 50U);
}

TEST_F(NoAllocationTest, TheCounterCounts) {
  const long before = allocations;
  std::vector<int> one(1);
  EXPECT_EQ(one.size(), 1U);
  EXPECT_EQ(allocations - before, 1);
}

INSTANTIATE_TEST_SUITE_P(Kernels, NoAllocationTest,
                         ::testing::Values(BinningKernel::kReference, BinningKernel::kSse4,
                                           BinningKernel::kAvx2));

}  // namespace
}  // namespace pilothouse
