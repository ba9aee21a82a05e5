#include <gtest/gtest.h>

#include "bench/floor_scoring.hpp"

namespace pilothouse::bench {
namespace {

using sim::Surface;

/// Five by five cells of 5 cm from x = 1 m on, all seen, all floor.
class FloorScoring : public ::testing::Test {
 protected:
  FloorScoring() {
    rule_.geometry.x_min = 1.0F;
    rule_.geometry.y_min = -0.125F;
    rule_.geometry.size_x = rule_.geometry.size_y = 5;
    counts_.assign(25, SurfaceCounts{});
    for (auto& cell : counts_) put(cell, Surface::kFloor, 10);
  }
  static void put(SurfaceCounts& cell, Surface surface, std::uint32_t count) {
    cell[static_cast<std::size_t>(surface)] = count;
  }
  SurfaceCounts& cell(int ix, int iy) { return counts_[rule_.geometry.index(ix, iy)]; }
  SceneTruth truth(const std::optional<sim::DropEdge>& edge = {}) const {
    return {truthOf(counts_, rule_, edge), measuredIn(counts_, rule_), false};
  }
  CellTruth truthAt(int ix, int iy, const std::optional<sim::DropEdge>& edge = {}) const {
    return truth(edge).cells[rule_.geometry.index(ix, iy)];
  }
  FloorScore scoreOf(const SceneTruth& truth, const std::vector<CellClass>& classes) const {
    return score(truth, classes, rule_.geometry);
  }
  std::vector<CellClass> all(CellClass c) const { return std::vector<CellClass>(25, c); }

  CellRule rule_;
  std::vector<SurfaceCounts> counts_;
};

TEST_F(FloorScoring, CellIsWhatAtLeastThreePerfectPointsSay) {
  put(cell(2, 2), Surface::kBox7cm, 3);
  put(cell(3, 2), Surface::kBox18cm, 2);
  put(cell(0, 0), Surface::kFloor, 2);
  EXPECT_EQ(truthAt(2, 2), CellTruth::kBox7cm);
  EXPECT_EQ(truthAt(3, 2), CellTruth::kUndecided);
  EXPECT_EQ(truthAt(0, 0), CellTruth::kUnseen);
  EXPECT_EQ(truthAt(1, 1), CellTruth::kFloor);
}

TEST_F(FloorScoring, HighSideOfARampIsUndecidedAndItsFootIsRamp) {
  put(cell(2, 2), Surface::kRamp, 4);
  put(cell(3, 2), Surface::kRampFoot, 4);
  put(cell(4, 2), Surface::kFloor, 0);
  put(cell(4, 2), Surface::kRamp, 4);
  EXPECT_EQ(truthAt(2, 2), CellTruth::kUndecided);
  EXPECT_EQ(truthAt(3, 2), CellTruth::kRamp);
  EXPECT_EQ(truthAt(4, 2), CellTruth::kRamp);
}

TEST_F(FloorScoring, EveryCellPastTheEdgeCountsSeenOrNot) {
  const sim::DropEdge edge{Eigen::Vector2d(1.0, 0.0), 1.12};
  for (int iy = 0; iy < 5; ++iy) put(cell(4, iy), Surface::kFloor, 0);
  EXPECT_EQ(truthAt(1, 0, edge), CellTruth::kFloor);
  EXPECT_EQ(truthAt(2, 0, edge), CellTruth::kUndecided);  // the edge runs through
  EXPECT_EQ(truthAt(3, 0, edge), CellTruth::kBeyond);
  EXPECT_EQ(truthAt(4, 0, edge), CellTruth::kBeyond);  // unseen
  std::vector<CellClass> classes = all(CellClass::kUnknown);
  EXPECT_EQ(scoreOf(truth(edge), classes).beyond_blocked.part, 10U);
  classes[rule_.geometry.index(4, 0)] = CellClass::kThreshold;
  EXPECT_EQ(scoreOf(truth(edge), classes).beyond_blocked.part, 9U);
}

TEST_F(FloorScoring, CountsHitsMissesAndFalseCells) {
  put(cell(2, 2), Surface::kBox18cm, 8);
  put(cell(2, 3), Surface::kBox18cm, 8);
  std::vector<CellClass> classes = all(CellClass::kFloor);
  classes[rule_.geometry.index(2, 2)] = CellClass::kObstacle;  // found
  classes[rule_.geometry.index(1, 2)] = CellClass::kObstacle;  // false, but next to one
  classes[rule_.geometry.index(0, 0)] = CellClass::kDropOff;   // false, far from any
  const FloorScore s = scoreOf(truth(), classes);
  EXPECT_EQ(s.iou.part, 1U);
  EXPECT_EQ(s.iou.whole, 4U);
  EXPECT_EQ(s.precision.part, 2U);
  EXPECT_EQ(s.precision.whole, 3U);
  EXPECT_EQ(s.recall_18cm.part, 1U);
  EXPECT_EQ(s.recall_18cm.whole, 2U);
  EXPECT_EQ(s.floor_drivable.whole - s.floor_drivable.part, 2U);
  EXPECT_FALSE(s.recall_7cm.isKnown());
}

TEST_F(FloorScoring, ObstacleCalledDropOffIsNotFound) {
  put(cell(2, 2), Surface::kBox7cm, 8);
  std::vector<CellClass> classes = all(CellClass::kFloor);
  classes[rule_.geometry.index(2, 2)] = CellClass::kDropOff;
  const FloorScore s = scoreOf(truth(), classes);
  EXPECT_EQ(s.recall_7cm.part, 0U);
  EXPECT_EQ(s.iou.part, 0U);
}

TEST_F(FloorScoring, UnknownIsAFaultWhereTheNoisyViewHasPoints) {
  SceneTruth scene = truth();
  const FloorScore seen = scoreOf(scene, all(CellClass::kUnknown));
  EXPECT_EQ(seen.floor_drivable.whole, 25U);
  EXPECT_EQ(seen.floor_drivable.part, 0U);
  scene.measured.assign(25, false);
  EXPECT_EQ(scoreOf(scene, all(CellClass::kUnknown)).floor_drivable.whole, 0U);
  // Who calls an unmeasured floor cell an obstacle is wrong all the same.
  EXPECT_EQ(scoreOf(scene, all(CellClass::kObstacle)).floor_drivable.whole, 25U);
}

TEST_F(FloorScoring, ObstacleThatTheNoisyViewLosesCountsInTheStrictRecallAlone) {
  put(cell(2, 2), Surface::kBox18cm, 8);
  SceneTruth scene = truth();
  scene.measured[rule_.geometry.index(2, 2)] = false;
  const FloorScore unknown = scoreOf(scene, all(CellClass::kUnknown));
  EXPECT_EQ(unknown.recall_18cm.whole, 0U);
  EXPECT_EQ(unknown.recall_18cm_strict.whole, 1U);
  EXPECT_EQ(unknown.recall_18cm_strict.part, 0U);
  EXPECT_EQ(scoreOf(scene, all(CellClass::kFloor)).recall_18cm.whole, 1U);
}

TEST_F(FloorScoring, CeilingCallsACellByItsNoisyPoints) {
  put(cell(2, 2), Surface::kBox18cm, 3);
  put(cell(3, 3), Surface::kBox18cm, 2);
  put(cell(0, 0), Surface::kFloor, 2);
  const std::vector<CellClass> classes = ceilingOf(counts_, rule_);
  EXPECT_EQ(classes[rule_.geometry.index(2, 2)], CellClass::kObstacle);
  EXPECT_EQ(classes[rule_.geometry.index(3, 3)], CellClass::kFloor);
  EXPECT_EQ(classes[rule_.geometry.index(0, 0)], CellClass::kUnknown);
}

TEST(CountSurfaces, PutsAPointIntoTheCellBelowIt) {
  CellRule rule;
  rule.geometry.x_min = 1.0F;
  rule.geometry.y_min = -0.125F;
  rule.geometry.size_x = rule.geometry.size_y = 5;
  sim::CameraModel camera;
  camera.width = camera.height = 1;
  camera.intrinsics = {1.0, 1.0, 0.0, 0.0};
  const sim::Mounting level{0.5, 0.0, 0.0};
  std::vector<SurfaceCounts> counts;
  // Straight ahead, 1.12 m: forward is the optical axis.
  countSurfaces({1.12F}, {Surface::kSill}, camera, level.T_base_optical(), rule, counts);
  EXPECT_EQ(counts[rule.geometry.index(2, 2)][static_cast<std::size_t>(Surface::kSill)], 1U);
  rule.clear_height = 0.4;  // the camera's own height is above it
  countSurfaces({1.12F}, {Surface::kSill}, camera, level.T_base_optical(), rule, counts);
  EXPECT_EQ(counts[rule.geometry.index(2, 2)][static_cast<std::size_t>(Surface::kSill)], 0U);
}

}  // namespace
}  // namespace pilothouse::bench
