#include "sim/random_world.hpp"

#include <gtest/gtest.h>

#include "sim/actor_path.hpp"
#include "sim/floor_plan.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kDrivable = 0.025;  // sills and what noise in float leaves
constexpr double kRobotTop = 0.75;
constexpr int kWorlds = 100;

/// Least distance on the floor from a point to what stands higher than a sill there; ramps are
/// driven over. By the triangles, without the plan that made the world.
double freeRadius(const WorldScene& scene, const World& world, const Eigen::Vector2d& point,
                  double reach) {
  const Eigen::Vector3f p(static_cast<float>(point.x()), static_cast<float>(point.y()), 0.0F);
  const float r = static_cast<float>(reach);
  const Eigen::AlignedBox3f box(p + Eigen::Vector3f(-r, -r, static_cast<float>(kDrivable)),
                                p + Eigen::Vector3f(r, r, static_cast<float>(kRobotTop)));
  double least = reach;
  scene.forEachSolidTriangle(box, [&](const WorldScene::SolidTriangle& t) {
    const Model& model = world.models[t.model];
    if (model.path || model.name.find("ramp") == 0 || model.name == "unexpected_box") return;
    for (int i = 0; i <= 20; ++i) {  // sampled: edges and inside
      for (int j = 0; i + j <= 20; ++j) {
        const float u = static_cast<float>(i) / 20.0F, v = static_cast<float>(j) / 20.0F;
        const Eigen::Vector3f at =
            t.corners[0] + u * (t.corners[1] - t.corners[0]) + v * (t.corners[2] - t.corners[0]);
        if (at.z() < static_cast<float>(kDrivable) || at.z() > static_cast<float>(kRobotTop))
          continue;
        least = std::min(least, static_cast<double>((at - p).head<2>().norm()));
      }
    }
  });
  return least;
}

TEST(RandomWorld, StartAndRouteAreFree) {
  const RandomWorldParameters parameters;
  const double need = parameters.robot_radius + parameters.clearance;
  double shortest = 1e9;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const RandomWorld random = randomWorld(seed, parameters);
    const WorldScene scene(random.world);
    const auto& route = random.world.routes.at("route");
    ASSERT_GE(route.size(), 2U) << seed;
    EXPECT_LT((route.front() - random.world.start.position()).norm(), 1e-9) << seed;
    double length = 0.0;
    for (std::size_t i = 1; i < route.size(); ++i) {
      const Eigen::Vector2d leg = route[i] - route[i - 1];
      length += leg.norm();
      const int steps = 1 + static_cast<int>(leg.norm() / 0.1);
      for (int s = 0; s <= steps; ++s) {
        const Eigen::Vector2d at = route[i - 1] + leg * s / steps;
        ASSERT_GE(freeRadius(scene, random.world, at, need), need - 0.005)
            << "seed " << seed << " at " << at.transpose();
        EXPECT_TRUE(scene.groundBelow(at, 0.3)) << seed;
      }
    }
    shortest = std::min(shortest, length);
  }
  EXPECT_GT(shortest, 1.5);
}

TEST(RandomWorld, SameSeedSameWorld) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const World a = randomWorld(seed).world, b = randomWorld(seed).world;
    ASSERT_EQ(a.models.size(), b.models.size());
    for (std::size_t m = 0; m < a.models.size(); ++m) {
      EXPECT_EQ(a.models[m].name, b.models[m].name);
      EXPECT_TRUE(a.models[m].T_world_model.isApprox(b.models[m].T_world_model, 0.0));
      ASSERT_EQ(a.models[m].parts.size(), b.models[m].parts.size());
      for (std::size_t p = 0; p < a.models[m].parts.size(); ++p)
        EXPECT_EQ(a.models[m].parts[p].mesh.vertices, b.models[m].parts[p].mesh.vertices);
    }
    EXPECT_EQ(a.routes, b.routes);
  }
  EXPECT_NE(randomWorld(1).world.start.x, randomWorld(2).world.start.x);
}

TEST(RandomWorld, PeopleStartAwayFromTheRobotAndWalkOnFreeFloor) {
  RandomWorldParameters parameters;
  parameters.least_people = 1;
  int people = 0;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const World world = randomWorld(seed, parameters).world;
    const WorldScene scene(world);
    for (const Model& model : world.models) {
      if (!model.path) continue;
      ++people;
      EXPECT_EQ(model.courtesy, parameters.courtesy);
      const double last = model.path->points.back().time;
      for (double time = 0.0; time < last; time += 0.5) {
        const Pose2 pose = poseAt(*model.path, time);
        EXPECT_GT((pose.position() - world.start.position()).norm(), 1.5) << seed;
        EXPECT_GE(freeRadius(scene, world, pose.position(), 0.3), 0.28) << seed;
      }
    }
  }
  EXPECT_GT(people, kWorlds);
}

TEST(RandomWorld, ABlockedRouteHasABoxOnIt) {
  RandomWorldParameters parameters;
  parameters.blocked_share = 1.0;
  int blocked = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const RandomWorld random = randomWorld(seed, parameters);
    if (!random.blocked) continue;
    ++blocked;
    const Model& box = random.world.models.back();
    ASSERT_EQ(box.name, "unexpected_box");
    const Eigen::Vector2d at = box.T_world_model.translation().head<2>();
    const auto& route = random.world.routes.at("route");
    double nearest = 1e9;
    for (std::size_t i = 1; i < route.size(); ++i) {
      const Eigen::Vector2d leg = route[i] - route[i - 1];
      const double share = std::clamp((at - route[i - 1]).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (at - route[i - 1] - share * leg).norm());
    }
    EXPECT_LT(nearest, 0.01) << seed;
    EXPECT_GT((at - random.world.start.position()).norm(), 1.5) << seed;
  }
  EXPECT_GT(blocked, 30);
  parameters.blocked_share = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_FALSE(randomWorld(seed, parameters).blocked);
}

TEST(RandomWorld, EverythingCanBeSeen) {
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    for (const Model& model : randomWorld(seed).world.models) {
      if (model.name == "floor" || model.name.find("ramp") == 0 || model.name.find("sill") == 0)
        continue;
      Eigen::AlignedBox3f box;
      for (const Part& part : model.parts)
        for (const auto& vertex : part.mesh.vertices) box.extend(vertex);
      EXPECT_GE(box.max().z(), 0.07F) << seed << " " << model.name;
      EXPECT_GE(box.sizes().minCoeff(), 0.03F) << seed << " " << model.name;
    }
  }
}

TEST(RandomWorld, RefusesWhatIsOutOfRange) {
  const auto refused = [](auto change) {
    RandomWorldParameters parameters;
    change(parameters);
    EXPECT_THROW(randomWorld(1, parameters), std::invalid_argument);
  };
  refused([](auto& p) { p.robot_radius = 0.0; });
  refused([](auto& p) { p.clearance = NAN; });
  refused([](auto& p) { p.blocked_share = 1.5; });
  refused([](auto& p) { p.least_people = 5; });
  refused([](auto& p) { p.most_people = 11; });
  refused([](auto& p) { p.route_length = 1.0; });
}

TEST(FloorPlan, MeasuresClearance) {
  FloorPlan plan({4.0, 3.0});
  EXPECT_NEAR(plan.clearance({1.0, 1.5}), 1.0, 1e-12);
  plan.addRectangle({2.0, 1.5, M_PI / 2.0}, {1.0, 0.2});
  EXPECT_NEAR(plan.clearance({1.5, 1.5}), 0.4, 1e-12);
  EXPECT_LT(plan.clearance({2.0, 1.5}), 0.0);
  plan.addDisc({1.0, 1.0}, 0.2);
  EXPECT_NEAR(plan.clearance({1.0, 1.5}), 0.3, 1e-12);
  EXPECT_FALSE(plan.isFree({1.5, 1.5}, {2.5, 1.5}, 0.05));
  EXPECT_TRUE(plan.isFree({1.5, 2.5}, {2.5, 2.5}, 0.3));
}

TEST(FloorPlan, FindsTheWayRoundAndNoneWhereThereIsNone) {
  FloorPlan open({6.0, 3.0});
  open.addRectangle({3.0, 1.0, 0.0}, {0.2, 2.0});
  const auto way = open.routeFrom({1.0, 0.6}, 0.3, 7.0);
  ASSERT_TRUE(way);
  EXPECT_GT(way->back().x(), 3.0);
  for (std::size_t i = 1; i < way->size(); ++i)
    EXPECT_TRUE(open.isFree((*way)[i - 1], (*way)[i], 0.3));
  FloorPlan closed({6.0, 3.0});
  closed.addRectangle({3.0, 1.5, 0.0}, {0.2, 3.0});
  EXPECT_LT(closed.routeFrom({1.0, 0.6}, 0.3, 7.0)->back().x(), 3.0);
  EXPECT_FALSE(closed.routeFrom({3.0, 1.5}, 0.3, 7.0));
}

}  // namespace
}  // namespace pilothouse::sim
