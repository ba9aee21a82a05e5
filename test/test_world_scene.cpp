#include <gtest/gtest.h>

#include "sim/actor_path.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {
namespace {

Mesh square(float half, float z) {
  Mesh mesh;
  mesh.vertices = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Model slab(const std::string& name, float half, double z) {
  Model model;
  model.name = name;
  model.T_world_model.translation().z() = z;
  model.parts.push_back({"top", square(half, 0.0F), {}, true, true});
  return model;
}

const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();

World floorAndTable() {
  World world;
  world.models = {slab("floor", 5.0F, 0.0), slab("table", 0.5F, 0.7)};
  return world;
}

TEST(WorldScene, HitsTheNearestModelAndSaysWhich) {
  const WorldScene scene(floorAndTable());
  const auto table = scene.cast({0.1, 0.2, 2.0}, kDown, 10.0, kCameraRay);
  ASSERT_TRUE(table);
  EXPECT_NEAR(table->distance, 1.3F, 1e-5F);
  EXPECT_EQ(table->model, 1U);
  EXPECT_LT((table->normal - Eigen::Vector3f::UnitZ()).norm(), 1e-6F);
  const auto floor = scene.cast({0.6, 0.2, 2.0}, kDown, 10.0, kCameraRay);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->model, 0U);
  EXPECT_FALSE(scene.cast({0.1, 0.2, 2.0}, kDown, 1.2, kCameraRay));
  EXPECT_FALSE(scene.cast({0.1, 0.2, 2.0}, -kDown, 10.0, kCameraRay));
}

TEST(WorldScene, RaysSeeAModelWhereItWasPlaced) {
  WorldScene scene(floorAndTable());
  for (const double x : {2.0, -1.5}) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << x, 0.0, 0.4;
    pose.linear() = Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitY()).toRotationMatrix();
    scene.place(1, pose);
    scene.commit();
    const auto hit = scene.cast({x, 0.0, 2.0}, kDown, 10.0, kRangerRay);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 1.6F, 1e-5F);
    EXPECT_EQ(hit->model, 1U);
    EXPECT_NEAR(hit->normal.x(), 0.5F, 1e-5F);
    EXPECT_EQ(scene.cast({0.1, 0.0, 2.0}, kDown, 10.0, kRangerRay)->model, 0U);
  }
  EXPECT_THROW(scene.place(2, Eigen::Isometry3d::Identity()), std::out_of_range);
}

TEST(WorldScene, EachKindOfRaySeesItsOwn) {
  World world = floorAndTable();
  Part& top = world.models[1].parts[0];
  const auto seen = [&](RayKind kind) {
    return WorldScene(world).cast({0.0, 0.0, 2.0}, kDown, 10.0, kind)->model == 1;
  };
  top.material.glass = true;
  world.models[0].parts[0].material.glass = true;  // so that each ray meets something
  EXPECT_TRUE(seen(kRangerRay));
  EXPECT_TRUE(seen(kSolidRay));
  EXPECT_TRUE(seen(kGlassRay));
  world.models[0].parts[0].material.glass = false;
  EXPECT_FALSE(seen(kCameraRay));
  top.material.glass = false;
  EXPECT_TRUE(seen(kCameraRay));
  top.visible = false;
  EXPECT_FALSE(seen(kCameraRay));
  EXPECT_FALSE(seen(kRangerRay));
  EXPECT_TRUE(seen(kSolidRay));
  top.visible = true;
  top.solid = false;
  EXPECT_TRUE(seen(kCameraRay));
  EXPECT_FALSE(seen(kSolidRay));
}

TEST(WorldScene, FindsTheGroundBelow) {
  const WorldScene scene(floorAndTable());
  EXPECT_NEAR(*scene.groundBelow({0.0, 0.0}, 2.0), 0.7, 1e-5);
  EXPECT_NEAR(*scene.groundBelow({0.0, 0.0}, 0.7), 0.7, 1e-5);
  EXPECT_NEAR(*scene.groundBelow({0.0, 0.0}, 0.5), 0.0, 1e-5);
  EXPECT_NEAR(*scene.groundBelow({3.0, 0.0}, 2.0), 0.0, 1e-5);
  EXPECT_FALSE(scene.groundBelow({8.0, 0.0}, 2.0));
}

TEST(WorldScene, GivesTheSolidTrianglesInABox) {
  World world = floorAndTable();
  WorldScene scene(world);
  const auto count = [&](const Eigen::AlignedBox3f& box) {
    std::vector<std::size_t> found(world.models.size(), 0);
    scene.forEachSolidTriangle(
        box, [&](const WorldScene::SolidTriangle& triangle) { ++found[triangle.model]; });
    return found;
  };
  const Eigen::AlignedBox3f low(Eigen::Vector3f(-0.2F, -0.2F, -0.1F),
                                Eigen::Vector3f(0.2F, 0.2F, 0.5F));
  EXPECT_EQ(count(low), (std::vector<std::size_t>{2, 0}));
  Eigen::AlignedBox3f high = low;
  high.max().z() = 0.8F;
  EXPECT_EQ(count(high), (std::vector<std::size_t>{2, 2}));
  Eigen::Isometry3d away = Eigen::Isometry3d::Identity();
  away.translation() << 2.0, 0.0, 0.7;
  scene.place(1, away);
  EXPECT_EQ(count(high), (std::vector<std::size_t>{2, 0}));
}

TEST(ActorPath, GoesStraightBetweenItsPointsAndStartsOver) {
  ActorPath path;
  path.points = {{1.0, {0.0, 0.0, 0.0}}, {3.0, {4.0, 0.0, 3.0}}, {5.0, {4.0, 2.0, -3.0}}};
  EXPECT_EQ(poseAt(path, 0.0).x, 0.0);
  EXPECT_NEAR(poseAt(path, 2.0).x, 2.0, 1e-12);
  EXPECT_NEAR(poseAt(path, 2.0).heading, 1.5, 1e-12);
  EXPECT_NEAR(std::abs(poseAt(path, 4.0).heading), M_PI, 1e-9);  // by the shorter way round
  EXPECT_NEAR(poseAt(path, 6.0).x, 2.0, 1e-12);
  path.loop = false;
  EXPECT_NEAR(poseAt(path, 6.0).y, 2.0, 1e-12);
  path.points.resize(1);
  path.loop = true;
  EXPECT_EQ(poseAt(path, 9.0).x, 0.0);
}

}  // namespace
}  // namespace pilothouse::sim
