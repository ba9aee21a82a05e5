// The map in three dimensions: what it learns from depth pictures, and its .bt files, of which the
// hostile ones never reach OctoMap's reader.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/mapping/octree_bytes.hpp"
#include "sim/depth_noise.hpp"
#include "sim/floor_scene.hpp"
#include "volume/volume_map.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector3d;

/// A camera 0.65 m above the floor before a box.
class Camera {
 public:
  explicit Camera(std::uint64_t seed = 1) : random_(seed) {
    sim::Mounting mounting;
    mounting.pitch = 0.45;
    T_base_optical_ = mounting.T_base_optical();
    model_.width = 320;
    model_.height = 240;
    model_.intrinsics = {262.0, 262.0, 159.5, 119.5};
  }
  void look(VolumeMap& map, const Eigen::Isometry3d& T_map_base = Eigen::Isometry3d::Identity()) {
    sim::FloorScene scene;
    const auto put = [&](const Vector3d& at, const Vector3d& size) {
      Eigen::Isometry3d T = T_map_base.inverse();
      T.translate(at);
      scene.solids.push_back(sim::makeBox(T, size, sim::Surface::kObstacle));
    };
    scene.solids.push_back(sim::makeGround(0.0, sim::Surface::kFloor));
    if (box) put({1.8, 0.0, 0.0}, {0.4, 0.4, 0.5});
    sim::render(scene, model_, T_base_optical_, view_);
    sim::measure(view_.depths, sim::DepthNoise{}, random_, depth_);
    DepthBytes bytes{};
    bytes.width = bytes.info_width = 320;
    bytes.height = bytes.info_height = 240;
    bytes.step = 640;
    bytes.encoding = "16UC1";
    bytes.data = reinterpret_cast<const std::uint8_t*>(depth_.data());
    bytes.size = depth_.size() * 2;
    bytes.intrinsics = model_.intrinsics;
    ASSERT_EQ(map.add(*DepthView::open(bytes), T_map_base * T_base_optical_), "");
  }
  bool box = true;

 private:
  sim::Random random_;
  Eigen::Isometry3d T_base_optical_;
  sim::CameraModel model_;
  sim::PerfectView view_;
  std::vector<std::uint16_t> depth_;
};

/// Share of the box's front that is occupied.
double front(const VolumeMap& map) {
  int occupied = 0, all = 0;
  for (double y = -0.15; y <= 0.15; y += 0.05) {
    for (double z = 0.1; z <= 0.45; z += 0.05) {
      ++all;
      occupied +=
          map.isOccupied({1.61, y + 0.01, z + 0.01}) || map.isOccupied({1.59, y + 0.01, z + 0.01});
    }
  }
  return static_cast<double>(occupied) / all;
}

TEST(VolumeMap, LearnsWhatStandsAndWhatIsFree) {
  VolumeMap map({});
  Camera camera;
  for (int i = 0; i < 4; ++i) camera.look(map);
  EXPECT_GT(front(map), 0.95);
  EXPECT_TRUE(map.isFree({1.0, 0.01, 0.3}));
  EXPECT_FALSE(map.isFree({1.9, 0.01, 0.2})) << "within the box";
  EXPECT_FALSE(map.isFree({2.3, 0.01, 0.1})) << "behind it";
  EXPECT_FALSE(map.isOccupied({2.3, 0.01, 0.1}));
}

TEST(VolumeMap, ClearsWhatLeft) {
  VolumeMap map({});
  Camera camera;
  for (int i = 0; i < 10; ++i) camera.look(map);
  camera.box = false;
  for (int i = 0; i < 4; ++i) camera.look(map);
  EXPECT_EQ(front(map), 0.0);
  EXPECT_TRUE(map.isFree({1.8, 0.01, 0.3}));
}

TEST(VolumeMap, KnowsAgainWhatLeftItsWindow) {
  VolumeMap map({});
  Camera camera;
  for (int i = 0; i < 4; ++i) camera.look(map);
  Eigen::Isometry3d away = Eigen::Isometry3d::Identity();
  for (double x = -1.0; x >= -20.0; x -= 1.0) {
    away.translation().x() = x;
    camera.look(map, away);
  }
  EXPECT_GT(front(map), 0.95);
  // Coming back and seeing it gone: the window must know from the octree that something stood.
  camera.box = false;
  for (int i = 0; i < 6; ++i) camera.look(map);
  EXPECT_EQ(front(map), 0.0);
}

TEST(VolumeMap, ComesBackFromItsFile) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    VolumeMap map({});
    Camera camera(seed);
    for (int i = 0; i < 4; ++i) camera.look(map);
    const std::string bytes = map.encode();
    VolumeMap again({});
    ASSERT_EQ(again.decode(bytes), "");
    EXPECT_EQ(again.encode(), bytes);
    EXPECT_EQ(front(again), front(map));
    camera.box = false;
    for (int i = 0; i < 6; ++i) camera.look(again);
    EXPECT_EQ(front(again), 0.0) << "what was loaded can be cleared";
  }
}

TEST(VolumeMap, IsWrittenEmptyToo) {
  VolumeMap map({}), again({});
  ASSERT_EQ(again.decode(map.encode()), "");
  EXPECT_EQ(again.report().nodes, 0U);
}

/// A camera 0.65 m above the floor that looks to its left, at what is so far away all over [mm].
void lookAside(VolumeMap& map, double x, std::uint16_t depth) {
  const std::vector<std::uint16_t> pixels(80 * 60, depth);
  DepthBytes bytes{};
  bytes.width = bytes.info_width = 80;
  bytes.height = bytes.info_height = 60;
  bytes.step = 160;
  bytes.encoding = "16UC1";
  bytes.data = reinterpret_cast<const std::uint8_t*>(pixels.data());
  bytes.size = pixels.size() * 2;
  bytes.intrinsics = {65.0, 65.0, 39.5, 29.5};
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  T.translation() = Vector3d(x, 0.0, 0.65);
  ASSERT_EQ(map.add(*DepthView::open(bytes), T), "");
}

/// Share of the wall 2 m aside that is known from one place along it to another.
double wallKnown(const VolumeMap& map, double from, double to) {
  int known = 0, all = 0;
  for (double x = from; x < to; x += 0.05, ++all) known += map.isOccupied({x, 2.01, 0.66});
  return static_cast<double>(known) / all;
}

TEST(VolumeMap, ForgetsWhatIsFarFirstAndKeepsWhatIsNear) {
  VolumeParameters parameters;
  parameters.max_nodes = 200000;
  VolumeMap map(parameters);
  for (int step = 0; step <= 1000; ++step) {
    lookAside(map, 0.5 * step, 2000);
    if (step % 100 != 0) continue;
    const double x = 0.5 * step;
    ASSERT_LE(map.report().nodes, 200000U) << "after " << x << " m";
    if (step == 0) continue;
    EXPECT_EQ(wallKnown(map, x - 4.0, x), 1.0) << "after " << x << " m";
    EXPECT_TRUE(map.isFree({x - 2.0, 1.0, 0.66}));
    EXPECT_EQ(wallKnown(map, 0.0, x - 40.0), 0.0) << "after " << x << " m";
  }
  EXPECT_GT(map.report().forgotten_nodes, 2000000U);
  EXPECT_EQ(map.report().refused_voxels, 0U);
  EXPECT_LE(map.report().bytes, 200000U * 48U);
  // What is left is whole, and what was forgotten is learnt again.
  VolumeMap again(parameters);
  ASSERT_EQ(again.decode(map.encode()), "");
  EXPECT_EQ(wallKnown(again, 496.0, 500.0), 1.0);
  for (int i = 0; i < 3; ++i) lookAside(map, 0.0, 2000);
  EXPECT_EQ(wallKnown(map, -1.0, 1.0), 1.0);
}

TEST(VolumeMap, ComesBackToWhatItForgotWhileItsWindowStillHeldIt) {
  VolumeParameters parameters;
  parameters.reach = 3.0;  // the window is 12.8 m wide, and the octree holds less of it
  parameters.max_nodes = 160000;
  VolumeMap map(parameters);
  for (int round = 0; round < 4; ++round) {
    for (double x = 0.0; x < 12.0; x += 0.5) lookAside(map, x, 2000);
    EXPECT_EQ(wallKnown(map, 10.0, 11.5), 1.0) << "round " << round;
    for (double x = 12.0; x > 0.0; x -= 0.5) lookAside(map, x, 2000);
    EXPECT_EQ(wallKnown(map, 0.5, 2.0), 1.0) << "round " << round;
  }
  EXPECT_GT(map.report().forgotten_nodes, 10000U);
}

TEST(VolumeMap, ClearsUpToTheReachBeforeWhatIsFartherAndNothingWithoutAnEcho) {
  VolumeMap map({});
  for (int i = 0; i < 2; ++i) lookAside(map, 0.0, 0);
  EXPECT_EQ(map.report().nodes, 0U) << "no measurement is not free";
  for (int i = 0; i < 2; ++i) lookAside(map, 0.0, 6000);
  EXPECT_TRUE(map.isFree({0.01, 3.9, 0.66}));
  EXPECT_FALSE(map.isFree({0.01, 4.2, 0.66}));
  map.forEachOccupied([](const Eigen::Vector3f& at, float) { ADD_FAILURE() << at.transpose(); });
}

TEST(VolumeMap, StopsGrowingWithAWord) {
  VolumeParameters parameters;
  parameters.max_nodes = 5000;
  VolumeMap map(parameters);
  Camera camera;
  for (int i = 0; i < 5; ++i) camera.look(map);
  EXPECT_LE(map.report().nodes, 5000U + 16U);
  EXPECT_GT(map.report().refused_voxels, 1000U);
}

TEST(VolumeMap, RefusesPosesThatCannotBe) {
  VolumeMap map({});
  const std::vector<std::uint16_t> pixels(16, 1000);
  DepthBytes bytes{4,     4,
                   8,     "16UC1",
                   false, reinterpret_cast<const std::uint8_t*>(pixels.data()),
                   32,    4,
                   4,     {4.0, 4.0, 1.5, 1.5}};
  const auto view = DepthView::open(bytes);
  ASSERT_TRUE(view);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (const double bad : {std::nan(""), 1e9, -HUGE_VAL}) {
    T.translation().x() = bad;
    EXPECT_NE(map.add(*view, T), "");
  }
  T.translation() = Vector3d(0.0, 0.0, 3.0);
  EXPECT_NE(map.add(*view, T).find("3.000000 m high"), std::string::npos);
  EXPECT_EQ(map.report().nodes, 0U);
}

std::string someOctree() {
  VolumeMap map({});
  Camera camera;
  for (int i = 0; i < 3; ++i) camera.look(map);
  return map.encode();
}

TEST(OctreeFile, HostileOnesAreRefusedAndTheMapStays) {
  const std::string good = someOctree();
  VolumeMap map({});
  ASSERT_EQ(map.decode(good), "");
  const std::size_t data = checkOctree(good)->data_offset;
  const auto header = [](const std::string& size, const std::string& res = "0.05",
                         const std::string& id = "OcTree") {
    return "# Octomap OcTree binary file\nid " + id + "\nsize " + size + "\nres " + res +
           "\ndata\n";
  };
  const struct {
    std::string bytes, words;
  } bad[] = {
      {std::string(2000000, '\xFF'), "the beginning is"},
      {header("1000000") + std::string(2000000, '\xFF'), "deeper than 16 levels"},
      {header("3") + std::string("\x03\x00", 2), "end after 2 bytes, expected more"},
      {good.substr(0, good.size() - 1), "expected more"},
      {good + "x", "are there"},
      {header("5") + std::string("\x01\x00", 2), "but the file holds 2 nodes"},
      {header("1") + std::string("\x00\x00", 2), "no children"},
      {header("0") + std::string("\x01\x00", 2), "nodes follow"},
      {header("2", "nan") + std::string("\x01\x00", 2), "res is \"nan\""},
      {header("2", "1e-300") + std::string("\x01\x00", 2), "expected 0.001 to 10"},
      {header("2", "0.1") + std::string("\x01\x00", 2), "expected 0.050000 as configured"},
      {header("-2") + std::string("\x01\x00", 2), "expected a whole number"},
      {header("2", "0.05", "ColorOcTree") + std::string("\x01\x00", 2), "expected OcTree"},
      {good.substr(0, data - 3), "expected data"},
      {"", "the beginning is"},
  };
  for (const auto& file : bad) {
    EXPECT_NE(map.decode(file.bytes).find(file.words), std::string::npos) << map.decode(file.bytes);
  }
  EXPECT_EQ(map.encode(), good);
}

// Whatever passes the check, OctoMap's own reader survives, and reads as many nodes.
TEST(OctreeFile, OctoMapReadsWhateverPasses) {
  const std::string good = someOctree();
  const std::size_t data = checkOctree(good)->data_offset;
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> place(data, good.size() - 1);
  int passed = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    for (int k = 0; k < 1 + i % 3; ++k) {
      bytes[place(random)] = static_cast<char>(random());
    }
    VolumeMap map({});
    const std::string fault = map.decode(bytes);
    if (!fault.empty()) continue;
    EXPECT_EQ(map.report().nodes, checkOctree(bytes)->nodes);
    ++passed;
  }
  EXPECT_GT(passed, 0);
}

}  // namespace
}  // namespace pilothouse
