#include <gtest/gtest.h>

#include <cmath>

#include "core/floor/mounting_calibrator.hpp"
#include "core/floor/plane_search.hpp"
#include "sim/floor_scene_kinds.hpp"
#include "test/rendered_view.hpp"

namespace pilothouse {
namespace {

constexpr double kDegree = 0.017453292519943295;

TEST(PlaneSearch, FindsTheFloorOfFurnishedScenesFromAnyMounting) {
  sim::Random random(11);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const sim::Mounting mounting{random.uniform(0.3, 1.2), random.uniform(10.0, 45.0) * kDegree,
                                 random.uniform(-15.0, 15.0) * kDegree};
    const RenderedView picture(sim::randomScene(sim::SceneKind::kBoxes, seed), mounting, seed);
    const auto plane = findFloorPlane(picture.view());
    ASSERT_TRUE(plane) << plane.reason();
    EXPECT_NEAR(plane->height, mounting.height, 0.01) << seed;
    const Eigen::Isometry3f T = mountingFromPlane(*plane);
    // Only the heading may differ from the truth.
    EXPECT_NEAR(pitchOf(plane->normal.cast<double>()), mounting.pitch, 0.5 * kDegree) << seed;
    EXPECT_TRUE(T.linear().row(2).isApprox(picture.T_base_optical().linear().row(2), 0.01F));
    EXPECT_NEAR(T.linear()(1, 2), 0.0F, 1e-6F);  // the camera looks along x
    EXPECT_GT(T.linear()(0, 2), 0.0F);
  }
}

TEST(PlaneSearch, SaysWhyThereIsNone) {
  sim::FloorScene wall;
  wall.solids.push_back(sim::makeBox(placed(2.0, 0.0), {0.2, 9.0, 9.0}, sim::Surface::kObstacle));
  const RenderedView picture(wall, {1.0, 0.0, 0.0});
  const auto plane = findFloorPlane(picture.view());
  ASSERT_FALSE(plane);
  EXPECT_NE(plane.reason().find("no floor found"), std::string::npos);
  const RenderedView nothing(sim::FloorScene{}, usualMounting());
  EXPECT_NE(findFloorPlane(nothing.view()).reason().find("0 of"), std::string::npos);
}

TEST(PlaneSearch, SameSeedSamePlane) {
  const RenderedView picture(sim::randomScene(sim::SceneKind::kBoxes, 3), usualMounting());
  EXPECT_EQ(findFloorPlane(picture.view())->normal, findFloorPlane(picture.view())->normal);
}

TEST(MountingCalibrator, KeepsHeadingAndPlaceOfTheCamera) {
  Eigen::Isometry3f T_configured = usualMounting().T_base_optical().cast<float>();
  T_configured = Eigen::Translation3f(0.1F, -0.2F, 0.0F) *
                 Eigen::AngleAxisf(0.4F, Eigen::Vector3f::UnitZ()) * T_configured;
  // The floor seems to rise by 2 degrees forward: the camera looks 2 degrees less down.
  MountingCalibrator calibrator;
  const FloorSlope plane{0.0, 0.035, 0.0};
  for (int frame = 0; frame < 10; ++frame) {
    calibrator.add(plane, T_configured, T_configured);
  }
  ASSERT_TRUE(calibrator.estimate().valid);
  const Eigen::Isometry3f T = calibrator.corrected(T_configured);
  EXPECT_NEAR(T.translation().x(), 0.1F, 1e-6F);
  EXPECT_NEAR(T.translation().y(), -0.2F, 1e-6F);
  const Eigen::Vector3f view = T.linear().col(2);
  EXPECT_NEAR(std::atan2(view.y(), view.x()), 0.4F, 1e-4F);
  // Seen through the corrected mounting the floor is level: its normal is up.
  const Eigen::Vector3f normal = Eigen::Vector3f(-0.035F, 0.0F, 1.0F).normalized();
  const Eigen::Vector3f corrected = T.linear() * T_configured.linear().transpose() * normal;
  EXPECT_TRUE(corrected.isApprox(Eigen::Vector3f::UnitZ(), 1e-4F));
  EXPECT_TRUE(T.linear().isUnitary(1e-5F));
  EXPECT_NEAR(T.linear().determinant(), 1.0F, 1e-5F);
}

TEST(MountingCalibrator, WithoutEnoughFramesChangesNothing) {
  const Eigen::Isometry3f T = usualMounting().T_base_optical().cast<float>();
  MountingCalibrator calibrator;
  EXPECT_TRUE(calibrator.corrected(T).isApprox(T));
  calibrator.add(FloorSlope{0.0, 0.05, 0.0}, T, T);
  EXPECT_FALSE(calibrator.estimate().valid);
  EXPECT_TRUE(calibrator.corrected(T).isApprox(T));
}

}  // namespace
}  // namespace pilothouse
