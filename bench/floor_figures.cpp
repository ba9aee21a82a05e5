#include "bench/floor_figures.hpp"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "bench/floor_bars.hpp"
#include "bench/grid_picture.hpp"

namespace pilothouse::bench {
namespace {

constexpr int kCell = 5;  // pixels

cv::Scalar truthColour(CellTruth t) {
  switch (t) {
    case CellTruth::kUnseen:
      return colourOf(CellClass::kUnknown);
    case CellTruth::kUndecided:
      return {150, 150, 150};
    case CellTruth::kFloor:
      return colourOf(CellClass::kFloor);
    case CellTruth::kRamp:
      return {190, 190, 90};
    case CellTruth::kSill:
      return {60, 210, 245};
    case CellTruth::kBox7cm:
      return {40, 140, 255};
    case CellTruth::kBox18cm:
      return {60, 60, 220};
    case CellTruth::kObstacle:
      return {40, 30, 140};
    case CellTruth::kBeyond:
      return {200, 70, 160};
  }
  return {0, 0, 0};
}

std::vector<LegendEntry> truthLegend() {
  return {{truthColour(CellTruth::kUnseen), "unseen"},
          {truthColour(CellTruth::kUndecided), "undecided"},
          {truthColour(CellTruth::kFloor), "floor"},
          {truthColour(CellTruth::kRamp), "ramp"},
          {truthColour(CellTruth::kSill), "sill"},
          {truthColour(CellTruth::kBox7cm), "7 cm"},
          {truthColour(CellTruth::kBox18cm), "18 cm"},
          {truthColour(CellTruth::kObstacle), "obstacle"},
          {truthColour(CellTruth::kBeyond), "beyond step"}};
}

const cv::Scalar kIgnored(70, 66, 62), kRightFree(190, 205, 190), kRightBlocked(120, 120, 120),
    kMissed(40, 30, 230), kFalse(30, 150, 255), kLeftUnknown(220, 150, 60),
    kWrongKind(200, 70, 160);

cv::Scalar faultColour(CellTruth t, CellClass c) {
  if (t == CellTruth::kUnseen || t == CellTruth::kUndecided) return kIgnored;
  if (isDrivable(t)) {
    if (isDrivable(c)) return kRightFree;
    return c == CellClass::kUnknown ? kLeftUnknown : kFalse;
  }
  if (isDrivable(c)) return kMissed;
  if (t == CellTruth::kBeyond || c == CellClass::kObstacle) return kRightBlocked;
  return c == CellClass::kUnknown ? kLeftUnknown : kWrongKind;
}

std::vector<LegendEntry> faultLegend() {
  return {{kRightFree, "right: drivable"},
          {kRightBlocked, "right: not"},
          {kMissed, "MISSED"},
          {kFalse, "FALSE"},
          {kLeftUnknown, "left unknown"},
          {kWrongKind, "called drop-off"}};
}

std::string titleOf(const char* method, const FloorScore& score) {
  char text[96];
  if (score.iou.isKnown()) {
    std::snprintf(text, sizeof text, "%s: IoU %.1f %%", method, percentOf(score.iou));
  } else {
    std::snprintf(text, sizeof text, "%s", method);
  }
  return text;
}

}  // namespace

void drawTrial(const FloorResult& r, const std::string& file) {
  const GridGeometry& g = r.geometry;
  const cv::Size size(g.size_y * kCell, g.size_x * kCell);
  std::vector<cv::Scalar> truth(r.truth.size()), faults(r.truth.size());
  for (std::size_t i = 0; i < r.truth.size(); ++i) {
    truth[i] = truthColour(r.truth[i]);
    faults[i] = faultColour(r.truth[i], r.improved_classes[i]);
  }
  const cv::Mat depth(static_cast<int>(r.image_height), static_cast<int>(r.image_width), CV_16UC1,
                      const_cast<std::uint16_t*>(r.image.data()));
  const std::vector<cv::Mat> panels = {
      panel(drawDepth(depth, 5.0), "depth, red near, blue 5 m", size),
      panel(drawGrid(g, truth, kCell), "truth", size, truthLegend()),
      panel(drawClasses(g, r.ceiling_classes, kCell), titleOf("ceiling", r.ceiling), size,
            classLegend()),
      panel(drawClasses(g, r.original_classes, kCell), titleOf("original", r.original), size,
            classLegend()),
      panel(drawClasses(g, r.improved_classes, kCell), titleOf("improved", r.improved), size,
            classLegend()),
      panel(drawGrid(g, faults, kCell), "faults of the improved method", size, faultLegend())};
  const std::string headline = std::string(nameOf(r.task.kind)) + ", run " +
                               std::to_string(r.task.run) +
                               (r.task.calibrating ? ", mount error, calibrated over 30 frames"
                                                   : ", mounting as configured");
  if (!cv::imwrite(file, sheet(panels, 3, headline))) {
    throw std::runtime_error("cannot write '" + file + "'");
  }
}

}  // namespace pilothouse::bench
