#include "sim/world_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/camera_rays.hpp"
#include "sim/fast_depth_noise.hpp"
#include "sim/shapes.hpp"

namespace pilothouse::sim {
namespace {

void add(World& world, const std::string& name, const Mesh& mesh, const Material& material = {}) {
  Model model;
  model.name = name;
  model.parts.push_back({name, mesh, material, true, true});
  world.models.push_back(model);
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Floor, a box, a sphere and a wall.
World scenery() {
  World world;
  add(world, "floor", planeMesh(Eigen::Vector3d::UnitZ(), {20.0, 20.0}));
  add(world, "box", moved(boxMesh({0.4, 0.6, 0.5}), at(2.0, 0.3, 0.25)));
  add(world, "sphere", moved(sphereMesh(0.3, 160), at(1.6, -0.6, 0.3)));
  add(world, "wall", moved(boxMesh({0.2, 8.0, 2.5}), at(4.0, 0.0, 1.25)));
  return world;
}

Eigen::Isometry3d eye() {
  return Mounting{0.65, 0.45, 0.02}.T_base_optical();
}

/// The scenery's distance along a ray, computed shape by shape.
double analyticDepth(const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  double nearest = -from.z() / along.z();
  if (!(nearest > 0.0)) nearest = 1e9;
  const auto box = [&](const Eigen::Vector3d& middle, const Eigen::Vector3d& size) {
    const Eigen::Vector3d low = (middle - size / 2.0 - from).cwiseQuotient(along);
    const Eigen::Vector3d high = (middle + size / 2.0 - from).cwiseQuotient(along);
    const double enter = low.cwiseMin(high).maxCoeff(), leave = low.cwiseMax(high).minCoeff();
    if (enter > 0.0 && enter < leave) nearest = std::min(nearest, enter);
  };
  box({2.0, 0.3, 0.25}, {0.4, 0.6, 0.5});
  box({4.0, 0.0, 1.25}, {0.2, 8.0, 2.5});
  const Eigen::Vector3d centre(1.6, -0.6, 0.3), off = from - centre;
  const double a = along.squaredNorm(), b = off.dot(along), c = off.squaredNorm() - 0.09;
  const double root = b * b - a * c;
  if (root > 0.0) nearest = std::min(nearest, (-b - std::sqrt(root)) / a);
  return nearest;
}

TEST(WorldCamera, SeesTheAnalyticDistances) {
  const World world = scenery();
  const WorldScene scene(world);
  const CameraProfile profile = *cameraProfile("kinect_qvga");
  WorldCamera camera(world, profile);
  camera.render(scene, eye(), WorldCamera::Wanted::kDepth);
  const Intrinsics& k = profile.model.intrinsics;
  std::size_t off = 0;
  for (std::size_t v = 0; v < profile.model.height; ++v) {
    for (std::size_t u = 0; u < profile.model.width; ++u) {
      const Eigen::Vector3d ray((static_cast<double>(u) - k.cx) / k.fx,
                                (static_cast<double>(v) - k.cy) / k.fy, 1.0);
      const double expected = analyticDepth(eye().translation(), eye().linear() * ray);
      const auto seen = static_cast<double>(camera.perfectDepth()[v * profile.model.width + u]);
      if (std::abs(seen - (expected < 100.0 ? expected : 0.0)) > 0.004)
        ++off;  // facets of the ball
    }
  }
  EXPECT_LT(off, 60U);  // pixels on an edge
}

TEST(WorldCamera, PacketsOfEverySizeAndSingleRaysAgree) {
  const World world = scenery();
  WorldScene scene(world);
  scene.place(2, at(0.2, 0.3, 0.1));  // one model as an instance
  scene.commit();
  CameraModel odd = cameraProfile("tof")->model;
  odd.width = 157;  // packets reach over the edges
  odd.height = 119;
  CameraRays rays(odd, {});
  CameraHits first, hits;
  rays.limitPacket(4);
  rays.cast(scene, eye(), true, first);
  for (const int packet : {8, 16}) {
    rays.limitPacket(packet);
    rays.cast(scene, eye(), true, hits);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < first.depth.size(); ++i)
      if (std::abs(hits.depth[i] - first.depth[i]) > 1e-4F) ++differ;
    EXPECT_LE(differ, 4U) << packet;
  }
  for (std::size_t i = 0; i < first.depth.size(); i += 37) {
    const double u = static_cast<double>(i % odd.width), v = static_cast<double>(i / odd.width);
    const Eigen::Vector3d ray((u - odd.intrinsics.cx) / odd.intrinsics.fx,
                              (v - odd.intrinsics.cy) / odd.intrinsics.fy, 1.0);
    const auto hit = scene.cast(eye().translation(), eye().linear() * ray, 200.0, kCameraRay);
    EXPECT_NEAR(hit ? hit->distance : 0.0F, first.depth[i], 1e-3F) << i;
  }
}

/// A wall at 2 m that fills the view, with glass or sunlight before its right half.
World halfBlind(bool glass) {
  World world;
  add(world, "wall", moved(boxMesh({0.2, 20.0, 20.0}), at(2.1, 0.0, 0.0)));
  if (!glass) {
    world.sunlight.emplace_back(Eigen::Vector3d(1.0, -10.0, -10.0),
                                Eigen::Vector3d(2.5, 0.0, 10.0));
    return world;
  }
  Material pane;
  pane.glass = true;
  add(world, "pane", moved(boxMesh({0.02, 10.0, 10.0}), at(1.0, -5.0, 0.0)), pane);
  return world;
}

TEST(WorldCamera, IsBlindBehindGlassAndInSunlightWhereItsProfileSaysSo) {
  for (const bool glass : {true, false}) {
    const World world = halfBlind(glass);
    const WorldScene scene(world);
    for (const bool blind : {true, false}) {
      CameraProfile profile = *cameraProfile("tof");
      profile.blind_on_glass = profile.blind_in_sunlight = blind;
      WorldCamera camera(world, profile);
      camera.render(scene, Mounting{0.0, 0.0, 0.0}.T_base_optical());
      const std::size_t row = 60 * profile.model.width;
      EXPECT_NEAR(camera.perfectDepth()[row + 10], 2.0F, 1e-4F);
      EXPECT_NEAR(camera.perfectDepth()[row + 150], blind ? 0.0F : 2.0F, 1e-4F);
    }
  }
}

TEST(WorldCamera, SameSeedSameBytes) {
  const World world = scenery();
  std::vector<std::uint16_t> depth[2];
  std::vector<std::uint8_t> colour[2];
  for (int run = 0; run < 2; ++run) {
    const WorldScene scene(world);
    WorldCamera camera(world, *cameraProfile("kinect"));
    for (std::uint64_t frame = 0; frame < 2; ++frame) {
      camera.render(scene, eye());
      std::vector<std::uint16_t> image(640 * 480);
      std::vector<std::uint8_t> rgb(3 * 640 * 480);
      camera.depth(7, frame, image.data());
      camera.colour(rgb.data());
      depth[run].insert(depth[run].end(), image.begin(), image.end());
      colour[run].insert(colour[run].end(), rgb.begin(), rgb.end());
    }
  }
  EXPECT_EQ(depth[0], depth[1]);
  EXPECT_EQ(colour[0], colour[1]);
  const auto half = depth[0].begin() + 640 * 480;
  EXPECT_FALSE(std::equal(depth[0].begin(), half, half));  // each frame has noise of its own
}

TEST(WorldCamera, ColoursWhatItSees) {
  World world;
  Material red;
  red.colour = {0.8F, 0.1F, 0.1F};
  add(world, "wall", moved(boxMesh({0.2, 20.0, 20.0}), at(2.1, 0.0, 0.0)), red);
  WorldScene scene(world);
  WorldCamera camera(world, *cameraProfile("tof"));
  std::vector<std::uint8_t> rgb(3 * 160 * 120);
  camera.render(scene, Mounting{}.T_base_optical(), WorldCamera::Wanted::kDepth);
  EXPECT_THROW(camera.colour(rgb.data()), std::logic_error);
  camera.render(scene, Mounting{}.T_base_optical());
  camera.colour(rgb.data());
  EXPECT_GT(rgb[0], 100);
  EXPECT_LT(rgb[1], 40);
  scene.place(0, at(50.0, 50.0, 0.0));
  scene.commit();
  camera.render(scene, Mounting{}.T_base_optical());
  camera.colour(rgb.data());
  EXPECT_GT(rgb[1], 150);  // the sky
}

TEST(CameraProfiles, AreWhatTheirNamesSay) {
  EXPECT_FALSE(cameraProfile("polaroid"));
  for (const std::string& name : cameraProfileNames()) {
    const auto profile = cameraProfile(name);
    ASSERT_TRUE(profile);
    EXPECT_NO_THROW(FastDepthNoise{profile->noise});
  }
  const auto kinect = cameraProfile("kinect")->model;
  EXPECT_NEAR(2.0 * std::atan(kinect.width / 2.0 / kinect.intrinsics.fx) * 180.0 / M_PI, 57.0, 6.0);
  EXPECT_EQ(cameraProfile("tof")->model.width, 160U);
  EXPECT_FALSE(cameraProfile("tof")->blind_in_sunlight);
}

struct Statistics {
  double mean, sigma, lost;
};

Statistics fast(const DepthNoise& noise, double depth) {
  constexpr std::size_t kCount = 1000000;
  const std::vector<float> depths(kCount, static_cast<float>(depth));
  std::vector<std::uint16_t> image(kCount);
  FastDepthNoise(noise).measure(depths.data(), kCount, 3, 4, image.data());
  double sum = 0.0, squares = 0.0, kept = 0.0;
  for (const std::uint16_t mm : image) {
    if (mm == 0) continue;
    const double error = mm / 1000.0 - depth;
    sum += error;
    squares += error * error;
    kept += 1.0;
  }
  return {sum / kept, std::sqrt(squares / kept - sum / kept * sum / kept), 1.0 - kept / kCount};
}

Statistics plain(const DepthNoise& noise, double depth) {
  constexpr int kCount = 300000;
  Random random(5);
  double sum = 0.0, squares = 0.0, kept = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double z = noise.measure(depth, random);
    if (z == 0.0) continue;
    const double error = std::floor(z * 1000.0 + 0.5) / 1000.0 - depth;
    sum += error;
    squares += error * error;
    kept += 1.0;
  }
  return {sum / kept, std::sqrt(squares / kept - sum / kept * sum / kept), 1.0 - kept / kCount};
}

TEST(FastDepthNoise, HasTheStatisticsOfTheReference) {
  for (const double depth : {0.55, 0.8, 1.5, 2.5, 4.0, 6.0}) {
    const DepthNoise noise;
    const Statistics f = fast(noise, depth), p = plain(noise, depth);
    EXPECT_NEAR(f.sigma, p.sigma, 0.015 * p.sigma) << depth;
    EXPECT_NEAR(f.mean, p.mean, 0.01 * p.sigma + 1e-5) << depth;
    EXPECT_NEAR(f.lost, noise.drop_out, 0.0005) << depth;
  }
}

TEST(FastDepthNoise, WithoutRoundingTheErrorIsNormal) {
  DepthNoise noise = cameraProfile("tof")->noise;
  noise.floor = 0.2;  // so that millimetres do not show
  noise.slope = 0.0;
  noise.nearest = 0.01;
  noise.farthest = 60.0;
  constexpr std::size_t kCount = 1000000;
  const std::vector<float> depths(kCount, 5.0F);
  std::vector<std::uint16_t> image(kCount);
  FastDepthNoise(noise).measure(depths.data(), kCount, 1, 1, image.data());
  const double limits[] = {-3.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0};
  for (const double limit : limits) {
    double below = 0.0, kept = 0.0;
    for (const std::uint16_t mm : image) {
      if (mm == 0) continue;
      kept += 1.0;
      if (mm / 1000.0 < 5.0 + limit * 0.2) below += 1.0;
    }
    EXPECT_NEAR(below / kept, 0.5 * std::erfc(-limit * M_SQRT1_2), 0.002) << limit;
  }
}

TEST(FastDepthNoise, NeighboursAndFramesAreUnrelated) {
  DepthNoise noise;
  noise.disparity_steps = 0.0;
  noise.drop_out = 0.0;
  const std::vector<float> depths(100000, 3.0F);
  std::vector<std::uint16_t> image(depths.size()), next(depths.size());
  const FastDepthNoise fast_noise(noise);
  fast_noise.measure(depths.data(), depths.size(), 1, 1, image.data());
  fast_noise.measure(depths.data(), depths.size(), 1, 2, next.data());
  const double variance = noise.sigma(3.0) * noise.sigma(3.0) * 1e6;
  const auto correlation = [&](const std::vector<std::uint16_t>& other, std::size_t shift) {
    double sum = 0.0;
    for (std::size_t i = 0; i + shift < image.size(); ++i)
      sum += (image[i] - 3000.0) * (other[i + shift] - 3000.0);
    return sum / static_cast<double>(image.size()) / variance;
  };
  EXPECT_NEAR(correlation(image, 0), 1.0, 0.03);
  for (const std::size_t shift : {1U, 2U, 4U, 640U, 1024U, 4096U})
    EXPECT_NEAR(correlation(image, shift), 0.0, 0.015) << shift;
  for (const std::size_t shift : {0U, 1U, 640U}) EXPECT_NEAR(correlation(next, shift), 0.0, 0.015);
}

TEST(FastDepthNoise, VectorsAndPlainGiveTheSameBytes) {
  std::mt19937 random(1);
  std::vector<float> depths(10007);
  for (float& depth : depths) depth = static_cast<float>(random() % 10000) / 1000.0F;
  std::vector<std::uint16_t> a(depths.size()), b(depths.size());
  for (const std::string& name : cameraProfileNames()) {
    const FastDepthNoise noise(cameraProfile(name)->noise);
    noise.measure(depths.data(), depths.size(), 9, 9, a.data());
    noise.measurePlain(depths.data(), depths.size(), 9, 9, b.data());
    EXPECT_EQ(a, b) << name;
  }
}

TEST(FastDepthNoise, RefusesRangesThatDoNotFit) {
  for (const auto& [nearest, farthest] :
       {std::make_pair(0.5, 70.0), std::make_pair(0.0, 8.0), std::make_pair(3.0, 2.0),
        std::make_pair(0.5, std::nan(""))}) {
    DepthNoise noise;
    noise.nearest = nearest;
    noise.farthest = farthest;
    EXPECT_THROW(FastDepthNoise{noise}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace pilothouse::sim
