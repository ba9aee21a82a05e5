#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/floor/floor_segmenter.hpp"
#include "core/floor/point_split.hpp"
#include "test/rendered_view.hpp"

namespace pilothouse {
namespace {

CellClass at(const FloorCells& grid, float x, float y) {
  const GridGeometry& g = grid.geometry;
  return grid.classes[g.index(static_cast<int>((x - g.x_min) / g.cell_size),
                              static_cast<int>((y - g.y_min) / g.cell_size))];
}

std::size_t count(const FloorCells& grid, CellClass wanted) {
  return static_cast<std::size_t>(std::count(grid.classes.begin(), grid.classes.end(), wanted));
}

FloorParameters with(FloorMethod method) {
  FloorParameters parameters;
  parameters.method = method;
  return parameters;
}

FloorCells judged(const sim::FloorScene& scene, const FloorParameters& parameters = {}) {
  const RenderedView picture(scene, usualMounting());
  FloorSegmenter segmenter(parameters);
  return segmenter.segment(picture.view(), picture.T_base_optical());
}

TEST(FloorSegmenter, AnEmptyFloorIsAllFloor) {
  const FloorCells grid = judged(emptyFloor());
  EXPECT_EQ(count(grid, CellClass::kObstacle), 0U);
  EXPECT_EQ(count(grid, CellClass::kDropOff), 0U);
  EXPECT_GT(count(grid, CellClass::kFloor), 3000U);
  EXPECT_EQ(at(grid, 0.3F, 0.0F), CellClass::kUnknown);  // below the picture
}

TEST(FloorSegmenter, TheTopOfABoxIsAnObstacleAndFooledTheOriginal) {
  sim::FloorScene scene = emptyFloor();
  scene.solids.push_back(sim::makeBox(placed(1.5, 0.0), {0.4, 0.4, 0.18}, sim::Surface::kBox18cm));
  EXPECT_EQ(at(judged(scene, with(FloorMethod::kOriginal)), 1.525F, 0.025F), CellClass::kFloor);
  const FloorCells grid = judged(scene);
  EXPECT_EQ(at(grid, 1.525F, 0.025F), CellClass::kObstacle);
  EXPECT_EQ(at(grid, 1.325F, 0.025F), CellClass::kObstacle);  // its front
  EXPECT_EQ(at(grid, 1.225F, 0.025F), CellClass::kFloor);
}

TEST(FloorSegmenter, BeyondAStepDownIsDropOffAndFooledTheOriginal) {
  sim::FloorScene scene;
  scene.edge = sim::DropEdge{{1.0, 0.0}, 1.8};
  scene.solids.push_back(sim::makeGround(*scene.edge));
  scene.solids.push_back(sim::makeGround(-0.10, sim::Surface::kLowerLevel));
  EXPECT_EQ(at(judged(scene, with(FloorMethod::kOriginal)), 2.525F, 0.025F), CellClass::kFloor);
  const FloorCells grid = judged(scene);
  EXPECT_EQ(at(grid, 2.525F, 0.025F), CellClass::kDropOff);
  // What the edge hides is part of it.
  EXPECT_EQ(at(grid, 1.925F, 0.025F), CellClass::kDropOff);
  EXPECT_EQ(at(grid, 1.625F, 0.025F), CellClass::kFloor);
}

TEST(FloorSegmenter, ASillIsAThresholdAndARampIsFloor) {
  sim::FloorScene scene = emptyFloor();
  scene.solids.push_back(sim::makeBox(placed(1.3, 0.0), {0.06, 2.0, 0.02}, sim::Surface::kSill));
  FloorParameters parameters;
  parameters.threshold_deviation = 0.004;
  const FloorCells grid = judged(scene, parameters);
  EXPECT_EQ(count(grid, CellClass::kObstacle), 0U);
  EXPECT_TRUE(at(grid, 1.275F, 0.025F) == CellClass::kThreshold ||
              at(grid, 1.325F, 0.025F) == CellClass::kThreshold);
  EXPECT_TRUE(isDrivable(at(grid, 1.6F, 0.025F)));

  sim::FloorScene ramp = emptyFloor();
  ramp.solids.push_back(sim::makeRamp(placed(1.4, 0.0), 10.0 * 0.0174533, 0.35, 20.0));
  const FloorCells slope = judged(ramp);
  EXPECT_TRUE(isDrivable(at(slope, 2.525F, 0.025F)));
  EXPECT_EQ(count(slope, CellClass::kObstacle), 0U);
}

TEST(FloorSegmenter, FloorBehindABoxIsStillFloor) {
  sim::FloorScene scene = emptyFloor();
  // As wide as the view, so that no floor leads round it.
  scene.solids.push_back(sim::makeBox(placed(1.2, 0.0), {0.1, 6.0, 0.1}, sim::Surface::kObstacle));
  const FloorCells grid = judged(scene);
  EXPECT_EQ(at(grid, 1.175F, 0.025F), CellClass::kObstacle);
  EXPECT_TRUE(isDrivable(at(grid, 2.525F, 0.025F)));
}

TEST(FloorSegmenter, ABoxBehindTheShadowOfARampIsNotItsContinuation) {
  sim::FloorScene scene = emptyFloor();
  scene.solids.push_back(sim::makeRamp(placed(1.1, -0.1), 6.0 * 0.0174533, 0.18, 0.9));
  scene.solids.push_back(
      sim::makeBox(placed(2.9, 1.05), {0.4, 0.45, 0.18}, sim::Surface::kBox18cm));
  const FloorCells grid = judged(scene);
  EXPECT_TRUE(isDrivable(at(grid, 2.9F, 0.0F)));  // the ramp's level end, as high as the box
  EXPECT_EQ(at(grid, 2.9F, 1.05F), CellClass::kObstacle);
}

TEST(FloorSegmenter, WithoutFloorAtTheRobotNothingIsDrivable) {
  sim::FloorScene scene;
  scene.solids.push_back(sim::makeGround(-0.4, sim::Surface::kLowerLevel));
  const FloorCells grid = judged(scene);
  EXPECT_EQ(count(grid, CellClass::kFloor) + count(grid, CellClass::kThreshold), 0U);
  EXPECT_GT(count(grid, CellClass::kObstacle) + count(grid, CellClass::kDropOff), 1000U);
}

// A low box right ahead, the floor shows beside it: the robot does not stand on the box.
TEST(FloorSegmenter, TheTopOfALowBoxThatFillsTheNearViewIsNotTheFloor) {
  for (const double height : {0.07, 0.08, 0.10}) {
    sim::FloorScene scene = emptyFloor();
    scene.solids.push_back(
        sim::makeBox(placed(0.85, -0.15), {0.6, 0.9, height}, sim::Surface::kObstacle));
    const FloorCells grid = judged(scene);
    EXPECT_EQ(count(grid, CellClass::kDropOff), 0U) << height;
    EXPECT_EQ(at(grid, 0.875F, 0.025F), CellClass::kObstacle) << height;
    EXPECT_EQ(at(grid, 1.075F, 0.525F), CellClass::kFloor) << height;
    EXPECT_EQ(at(grid, 2.025F, 0.025F), CellClass::kFloor) << height;
  }
}

// A box right ahead parts the view: floor that soon rises to a ramp on the left, floor on the
// right.
TEST(FloorSegmenter, ARampBesideABoxDoesNotTiltTheFloorOnItsOtherSide) {
  sim::FloorScene scene = emptyFloor();
  scene.solids.push_back(
      sim::makeBox(placed(0.975, -0.05), {0.85, 0.3, 0.5}, sim::Surface::kObstacle));
  Eigen::Isometry3d T_base_ramp = placed(0.95, 0.25);
  T_base_ramp.rotate(Eigen::AngleAxisd(1.06, Eigen::Vector3d::UnitZ()));
  scene.solids.push_back(sim::makeRamp(T_base_ramp, 4.7 * 0.0174533, 0.3, 6.0));
  const FloorCells grid = judged(scene);
  EXPECT_EQ(count(grid, CellClass::kDropOff), 0U);
  for (const float x : {0.975F, 1.225F, 1.525F}) {
    EXPECT_EQ(at(grid, x, -0.625F), CellClass::kFloor) << x;
  }
  EXPECT_EQ(at(grid, 0.725F, 0.275F), CellClass::kFloor);
  EXPECT_TRUE(isDrivable(at(grid, 1.525F, 0.475F))) << "the ramp";
}

TEST(FloorSegmenter, FewPointsOfABoxCountOneStrayPointDoesNot) {
  // A cell with 200 points of floor, seen from above at 1 m, so that noise is small.
  FloorParameters parameters;
  parameters.range = 2.0;
  parameters.half_width = 1.0;
  const auto judgedWith = [&](int raised) {
    std::vector<float> points;
    const auto add = [&](float x, float y, float z) {
      points.insert(points.end(), {x, y, z, 0.0F});
    };
    for (int ix = 0; ix < 34; ++ix) {
      for (int iy = 0; iy < 38; ++iy) {
        for (int k = 0; k < 20; ++k) {
          add(0.225F + 0.05F * static_cast<float>(ix), -0.925F + 0.05F * static_cast<float>(iy),
              0.0F);
        }
      }
    }
    for (int k = 0; k < raised; ++k) add(1.225F, 0.025F, 0.09F);
    static constexpr CloudField kFields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
    CloudBytes bytes{};
    bytes.width = static_cast<std::uint32_t>(points.size() / 4);
    bytes.height = 1;
    bytes.point_step = 16;
    bytes.row_step = bytes.width * 16;
    bytes.fields = kFields;
    bytes.field_count = 3;
    bytes.data = reinterpret_cast<const std::uint8_t*>(points.data());
    bytes.size = points.size() * sizeof(float);
    FloorSegmenter segmenter(parameters);
    return at(segmenter.segment(*CloudView::open(bytes), Eigen::Isometry3f::Identity()), 1.225F,
              0.025F);
  };
  EXPECT_EQ(judgedWith(0), CellClass::kFloor);
  EXPECT_EQ(judgedWith(1), CellClass::kFloor);
  EXPECT_EQ(judgedWith(4), CellClass::kObstacle);
}

TEST(FloorSegmenter, FindsTheErrorOfTheMountingAndUsesItWhenAsked) {
  const sim::Mounting truth{0.67, (26.0 - 2.5) * 0.0174533, 2.0 * 0.0174533};
  const Eigen::Isometry3f T_configured = usualMounting().T_base_optical().cast<float>();
  for (const bool used : {false, true}) {
    FloorParameters parameters;
    parameters.calibrate_mounting = used;
    FloorSegmenter segmenter(parameters);
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
      const RenderedView picture(emptyFloor(), truth, frame);
      segmenter.segment(picture.view(), T_configured);
    }
    const MountingEstimate& found = segmenter.mounting();
    ASSERT_TRUE(found.valid);
    EXPECT_NEAR(found.height_error, 0.02, 0.005);
    EXPECT_NEAR(found.pitch_error, -2.5 * 0.0174533, 0.2 * 0.0174533);
    EXPECT_NEAR(found.roll_error, 2.0 * 0.0174533, 0.2 * 0.0174533);
    const Eigen::Isometry3f& T = segmenter.mountingUsed();
    if (used) {
      EXPECT_TRUE(T.isApprox(truth.T_base_optical().cast<float>(), 2e-3F));
    } else {
      EXPECT_TRUE(T.isApprox(T_configured));
    }
    segmenter.reset();
    EXPECT_FALSE(segmenter.mounting().valid);
  }
}

TEST(FloorSegmenter, RefusedParametersLeaveTheOldOnes) {
  FloorSegmenter segmenter(FloorParameters{});
  FloorParameters wrong;
  wrong.cell_size = 0.0;
  EXPECT_THROW(segmenter.setParameters(wrong), std::invalid_argument);
  EXPECT_EQ(segmenter.parameters().cell_size, FloorParameters{}.cell_size);
  FloorParameters other;
  other.cell_size = 0.1;
  segmenter.setParameters(other);
  const RenderedView picture(emptyFloor(), usualMounting());
  EXPECT_FLOAT_EQ(segmenter.segment(picture.view(), picture.T_base_optical()).geometry.cell_size,
                  0.1F);
}

TEST(PointSplit, KeepsTheFloorAtTheFootOfABoxAndTheBoxApart) {
  sim::FloorScene scene = emptyFloor();
  scene.solids.push_back(sim::makeBox(placed(1.4, 0.0), {0.3, 0.5, 0.18}, sim::Surface::kBox18cm));
  const RenderedView picture(scene, usualMounting());
  FloorSegmenter segmenter(FloorParameters{});
  const FloorCells& grid = segmenter.segment(picture.view(), picture.T_base_optical());
  std::vector<CellClass> classes;
  splitPoints(picture.view(), picture.T_base_optical(), grid, segmenter.parameters(), classes);
  ASSERT_EQ(classes.size(), picture.surfaces().size());
  std::size_t box = 0, box_found = 0, floor = 0, floor_found = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (classes[i] == CellClass::kUnknown) continue;
    if (picture.surfaces()[i] == sim::Surface::kFloor) {
      ++floor;
      floor_found += isDrivable(classes[i]) ? 1 : 0;
    } else {
      ++box;
      box_found += classes[i] == CellClass::kObstacle ? 1 : 0;
    }
  }
  ASSERT_GT(box, 5000U);
  EXPECT_GT(static_cast<double>(box_found), 0.93 * static_cast<double>(box));
  EXPECT_GT(static_cast<double>(floor_found), 0.995 * static_cast<double>(floor));
}

}  // namespace
}  // namespace pilothouse
