#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/depth_noise.hpp"
#include "sim/floor_scene_kinds.hpp"

namespace pilothouse::sim {
namespace {

struct Statistics {
  double mean = 0.0, deviation = 0.0, lost = 0.0;
};

Statistics measureMany(double depth, const DepthNoise& noise) {
  constexpr int kDraws = 200000;
  Random random(11);
  double sum = 0.0, square = 0.0;
  int valid = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double z = noise.measure(depth, random);
    if (!(z > 0.0)) continue;
    ++valid;
    sum += z - depth;
    square += (z - depth) * (z - depth);
  }
  const double mean = sum / valid;
  return {mean, std::sqrt(square / valid - mean * mean), 1.0 - static_cast<double>(valid) / kDraws};
}

TEST(DepthNoise, HasTheDeviationOfTheModel) {
  DepthNoise noise;
  noise.disparity_steps = 1e7;  // the normal part alone
  for (const double depth : {0.8, 1.5, 2.5, 3.5}) {
    const double expected = 0.0012 + 0.0019 * (depth - 0.4) * (depth - 0.4);
    const Statistics s = measureMany(depth, noise);
    EXPECT_NEAR(s.mean, 0.0, 0.01 * expected) << depth;
    EXPECT_NEAR(s.deviation, expected, 0.01 * expected) << depth;
    EXPECT_NEAR(s.lost, 0.01, 0.001) << depth;
  }
  EXPECT_DOUBLE_EQ(noise.sigma(0.2), 0.0012);
}

TEST(DepthNoise, GivesWholeStepsOfDisparityAlone) {
  const DepthNoise noise;
  Random random(3);
  std::set<long> steps;
  for (int i = 0; i < 2000; ++i) {
    const double z = noise.measure(3.0, random);
    if (!(z > 0.0)) continue;
    const double disparity = noise.focal_baseline / z * 8.0;
    EXPECT_NEAR(disparity, std::round(disparity), 1e-6);
    steps.insert(std::lround(disparity));
  }
  // 13.125 pixels, one eighth apart: three steps either way is what sigma = 14 mm reaches.
  EXPECT_TRUE(steps.count(105));
  EXPECT_LE(*steps.rbegin() - *steps.begin(), 6);
}

TEST(DepthNoise, LosesWhatIsOutOfRange) {
  const DepthNoise noise;
  Random random(5);
  std::vector<std::uint16_t> image;
  measure({0.3F, 0.0F, 9.0F, 100.0F}, noise, random, image);
  EXPECT_EQ(image, std::vector<std::uint16_t>(4, 0));
}

TEST(DepthNoise, DrawsAsManyNumbersWhateverTheDepth) {
  const DepthNoise noise;
  Random a(9), b(9);
  std::vector<std::uint16_t> first, second;
  measure({1.0F, 0.0F, 1.0F, 2.0F}, noise, a, first);
  measure({1.0F, 1.5F, 1.0F, 2.0F}, noise, b, second);
  second[1] = first[1];
  EXPECT_EQ(first, second);
}

std::uint64_t hashOf(SceneKind kind, std::uint64_t seed) {
  const CameraModel camera;
  PerfectView view;
  render(randomScene(kind, seed), camera, Mounting{0.65, 0.4538, 0.0}.T_base_optical(), view);
  Random random(seed);
  std::vector<std::uint16_t> image;
  measure(view.depths, DepthNoise{}, random, image);
  std::uint64_t hash = 0xCBF29CE484222325ULL;  // FNV-1a
  for (const std::uint16_t mm : image) hash = (hash ^ mm) * 0x100000001B3ULL;
  for (const Surface s : view.surfaces) {
    hash = (hash ^ static_cast<std::uint64_t>(s)) * 0x100000001B3ULL;
  }
  return hash;
}

TEST(RandomScene, IsTheSameForTheSameSeedOnEveryMachine) {
  std::uint64_t all = 0;
  for (const SceneKind kind : kSceneKinds) all = mixSeed(all, hashOf(kind, 42));
  // Changes only where the scenes or the noise are changed on purpose.
  EXPECT_EQ(all, 14174660717470954213ULL);
  EXPECT_NE(hashOf(SceneKind::kBoxes, 42), hashOf(SceneKind::kBoxes, 43));
}

TEST(RandomScene, ShowsWhatItsKindPromises) {
  const CameraModel camera;
  const auto count = [&](SceneKind kind, Surface surface) {
    std::ptrdiff_t sum = 0;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      PerfectView view;
      render(randomScene(kind, seed), camera, Mounting{0.65, 0.4538, 0.0}.T_base_optical(), view);
      sum += std::count(view.surfaces.begin(), view.surfaces.end(), surface);
    }
    return sum;
  };
  EXPECT_GT(count(SceneKind::kBoxes7cm, Surface::kBox7cm), 0);
  EXPECT_GT(count(SceneKind::kBoxes18cm, Surface::kBox18cm), 0);
  EXPECT_GT(count(SceneKind::kBoxes, Surface::kObstacle), 0);
  EXPECT_GT(count(SceneKind::kRamp, Surface::kRamp), 0);
  EXPECT_GT(count(SceneKind::kSills, Surface::kSill), 0);
  EXPECT_GT(count(SceneKind::kDropOff, Surface::kLowerLevel), 0);
  for (const Surface other : {Surface::kRamp, Surface::kSill, Surface::kObstacle}) {
    EXPECT_EQ(count(SceneKind::kEmpty, other), 0);
  }
}

}  // namespace
}  // namespace pilothouse::sim
