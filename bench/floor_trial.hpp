#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/floor_scoring.hpp"
#include "core/floor/floor_parameters.hpp"
#include "sim/floor_scene.hpp"
#include "sim/floor_scene_kinds.hpp"

namespace pilothouse::bench {

/// One scene to be judged.
struct FloorTask {
  int run = 0;
  sim::SceneKind kind = sim::SceneKind::kEmpty;
  /// The camera hangs up to 3 degrees and 2 cm off its configured mounting and finds out by itself.
  bool calibrating = false;
};

/// How far the mounting that was found is from the true one.
struct MountingFault {
  double angle_deg = 0.0;  ///< the larger of pitch and roll
  double height = 0.0;     ///< [m]
};

struct FloorResult {
  FloorTask task;
  FloorScore ceiling, original, improved;
  std::optional<MountingFault> mounting;  ///< calibrating and found
  Share doors_agree;  ///< cells that the improved method calls the same from depth and from cloud
  // For the pictures, kept on demand.
  std::vector<std::uint16_t> image;  ///< [mm]
  std::uint32_t image_width = 0, image_height = 0;
  std::vector<CellTruth> truth;
  std::vector<CellClass> ceiling_classes, original_classes, improved_classes;
  GridGeometry geometry;
};

/// Renders the scene, lets every method judge it and scores them.
FloorResult runTrial(const FloorTask& task, std::uint64_t seed, bool keep_pictures);

}  // namespace pilothouse::bench
