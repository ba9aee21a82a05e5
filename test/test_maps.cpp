#include <gtest/gtest.h>

#include "sim/world_file.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {
namespace {

Checked<LoadedWorld> loadMap(const std::string& name) {
  return loadWorld(std::string(PILOTHOUSE_SOURCE "/maps/") + name + ".sdf");
}

/// Every world of the package loads without a complaint, and its robot stands on a floor.
TEST(Maps, AllLoadWithoutWarnings) {
  for (const char* name :
       {"corridor", "crossing", "experiment_boxes", "experiment_corridor", "experiment_crossing",
        "experiment_ramp", "experiment_route", "furnished_room"}) {
    const auto loaded = loadMap(name);
    ASSERT_TRUE(loaded) << loaded.reason();
    EXPECT_TRUE(loaded->warnings.empty()) << name << ": " << loaded->warnings.front();
    EXPECT_EQ(loaded->world.name, name);
    const WorldScene scene(loaded->world);
    const auto ground = scene.groundBelow(loaded->world.start.position(), 0.5);
    ASSERT_TRUE(ground) << name;
    EXPECT_NEAR(*ground, 0.0, 1e-5) << name;
  }
}

/// Distance on the floor from a point to what stands more than a sill above the ground there.
double freeRadius(const WorldScene& scene, const World& world, const Eigen::Vector2d& point) {
  constexpr float kReach = 0.6F;
  const auto ground = static_cast<float>(scene.groundBelow(point, 0.5).value());
  const float low = ground + 0.025F, high = ground + 0.75F;
  const Eigen::Vector2f p = point.cast<float>();
  const Eigen::AlignedBox3f box(Eigen::Vector3f(p.x() - kReach, p.y() - kReach, low),
                                Eigen::Vector3f(p.x() + kReach, p.y() + kReach, high));
  float least = kReach;
  scene.forEachSolidTriangle(box, [&](const WorldScene::SolidTriangle& t) {
    if (world.models[t.model].path || world.models[t.model].name == "hump") return;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps;
        const Eigen::Vector3f at =
            t.corners[0] + u * (t.corners[1] - t.corners[0]) + v * (t.corners[2] - t.corners[0]);
        if (at.z() > low && at.z() < high) least = std::min(least, (at.head<2>() - p).norm());
      }
    }
  });
  return static_cast<double>(least);
}

TEST(Maps, TheTourLeavesTheRoomThatItSays) {
  const auto loaded = loadMap("furnished_room");
  ASSERT_TRUE(loaded) << loaded.reason();
  const World& world = loaded->world;
  const WorldScene scene(world);
  const auto& tour = world.routes.at("tour");
  EXPECT_EQ(tour.front(), tour.back());
  EXPECT_EQ(tour.front(), world.start.position());
  double narrowest = 1.0;
  for (std::size_t i = 1; i < tour.size(); ++i) {
    const Eigen::Vector2d leg = tour[i] - tour[i - 1];
    const int steps = static_cast<int>(leg.norm() / 0.1);
    for (int s = 0; s <= steps; ++s) {
      const Eigen::Vector2d at = tour[i - 1] + leg * s / steps;
      const double spare = freeRadius(scene, world, at) - 0.20;  // beside half the robot's width
      const bool at_suitcase = (at - Eigen::Vector2d(2.7, 1.2)).norm() < 0.7;
      EXPECT_GE(spare, at_suitcase ? 0.14 : 0.24) << at.transpose();
      narrowest = std::min(narrowest, spare);
    }
  }
  EXPECT_NEAR(narrowest, 0.15, 0.02);
}

}  // namespace
}  // namespace pilothouse::sim
