#include "core/floor/improved_method.hpp"

#include <algorithm>
#include <cmath>

#include "core/floor/raised_part.hpp"

namespace pilothouse {
namespace {

constexpr float kSeedHalfWidth =
    0.75F;                           // the robot's floor is looked for this far to the sides [m]
constexpr float kSeedDepth = 0.5F;   // and this far beyond the nearest cell seen [m]
constexpr float kTiltSlack = 0.06F;  // tan 3.4 deg: a mounting not yet calibrated [m/m]
constexpr int kOffsetSamples = 15;
constexpr float kNoiseSigmas = 2.0F;  // of noise that a patch may lie off the floor beyond a step
constexpr std::uint32_t kFewPoints = 8;  // so many of one cell alone tell of a step down
constexpr float kFloorSlack = 0.001F;    // how well the floor's height at a cell is known [m]

}  // namespace

void ImprovedMethod::configure(const FloorParameters& parameters, const GridGeometry& geometry) {
  parameters_ = parameters;
  geometry_ = geometry;
  noise_known_ = false;
  noise_variance_.assign(geometry.cells(), 0.0F);
  even_.assign(geometry.cells(), 0);
  floor_.assign(geometry.cells(), 0);
  kinds_.reserve(geometry.cells());
  votes_.reserve(geometry.cells());
  offsets_.reserve(kOffsetSamples + 1);
  patches_.configure(geometry);
  surface_.configure(geometry);
  near_floor_.configure(geometry);
}

std::optional<FloorSlope> ImprovedMethod::judge(const Eigen::Isometry3f& T_base_camera,
                                                FloorCells& grid) {
  home_.reset();
  updateNoise(T_base_camera);
  findEven(grid);
  patches_.find(grid, even_, static_cast<float>(parameters_.step_height));
  kinds_.assign(patches_.patches().size(), PatchKind::kUndecided);
  std::fill(floor_.begin(), floor_.end(), std::uint8_t{0});
  const int robot = robotPatch(grid);
  if (robot >= 0) {
    kinds_[static_cast<std::size_t>(robot)] = PatchKind::kFloor;
    const FloorPatch& patch = patches_.patches()[static_cast<std::size_t>(robot)];
    for (std::uint32_t k = 0; k < patch.size; ++k) floor_[patches_.cells()[patch.first + k]] = 1;
    joinIslands(grid, T_base_camera.translation());
  }
  classify(grid);
  dropLoneDropOffs(grid);
  markHiddenByEdge(T_base_camera.translation(), grid);
  return home_;
}

void ImprovedMethod::updateNoise(const Eigen::Isometry3f& T_base_camera) {
  if (noise_known_ && T_base_camera.matrix() == T_base_camera_.matrix()) return;
  noise_known_ = true;
  T_base_camera_ = T_base_camera;
  const Eigen::Vector3f camera = T_base_camera.translation();
  const Eigen::Vector3f axis = T_base_camera.linear().col(2);
  const auto sigma_floor = static_cast<float>(parameters_.noise_floor);
  const auto sigma_slope = static_cast<float>(parameters_.noise_slope);
  for (int iy = 0; iy < geometry_.size_y; ++iy) {
    for (int ix = 0; ix < geometry_.size_x; ++ix) {
      const Eigen::Vector3f ray =
          Eigen::Vector3f(geometry_.centreX(ix), geometry_.centreY(iy), 0.0F) - camera;
      const float depth = std::max(0.1F, ray.dot(axis));
      // A depth error moves the point along its ray, so its height by camera.z / depth of it.
      const float sigma_depth = sigma_floor + sigma_slope * (depth - 0.4F) * (depth - 0.4F);
      const float sigma_height = sigma_depth * camera.z() / depth;
      noise_variance_[geometry_.index(ix, iy)] = sigma_height * sigma_height;
    }
  }
}

void ImprovedMethod::findEven(const FloorCells& grid) {
  const auto limit = static_cast<float>(parameters_.obstacle_deviation);
  const float variance_limit = limit * limit;
  for (std::size_t i = 0; i < even_.size(); ++i) {
    const float d = grid.deviations[i];
    // NaN, that is unknown, is not even.
    even_[i] = d * d - noise_variance_[i] <= variance_limit ? 1 : 0;
  }
}

/// The patch with the most cells near the robot at about its height, or -1. The nearer a cell is to
/// that height the more it counts: the top of a low box right ahead shows more cells than the floor
/// beside it, which would be a drop-off to one who stands on the box.
int ImprovedMethod::robotPatch(const FloorCells& grid) {
  int nearest = 0;
  while (nearest < geometry_.size_x && !hasEvenCell(nearest)) ++nearest;
  const int end =
      std::min(geometry_.size_x, nearest + 1 + static_cast<int>(kSeedDepth / geometry_.cell_size));
  votes_.assign(patches_.patches().size(), 0.0F);
  int best = -1;
  for (int iy = 0; iy < geometry_.size_y; ++iy) {
    if (std::abs(geometry_.centreY(iy)) > kSeedHalfWidth) continue;
    for (int ix = nearest; ix < end; ++ix) {
      const std::size_t i = geometry_.index(ix, iy);
      const int patch = patches_.patchOf()[i];
      const float limit = static_cast<float>(parameters_.seed_height) +
                          kTiltSlack * std::abs(geometry_.centreX(ix));
      if (patch < 0 || std::abs(grid.heights[i]) > limit) continue;
      const float level = 1.0F - std::abs(grid.heights[i]) / limit;
      const float votes = votes_[static_cast<std::size_t>(patch)] += level * level;
      if (best < 0 || votes > votes_[static_cast<std::size_t>(best)]) best = patch;
    }
  }
  return best;
}

bool ImprovedMethod::hasEvenCell(int ix) const {
  for (int iy = 0; iy < geometry_.size_y; ++iy) {
    if (even_[geometry_.index(ix, iy)] != 0) return true;
  }
  return false;
}

/// Median difference between the patch's heights and those expected at (ix, iy) [m].
template <class Expected>
float ImprovedMethod::patchOffset(const FloorPatch& patch, const FloorCells& grid,
                                  Expected expected) {
  offsets_.clear();
  const std::uint32_t stride = std::max<std::uint32_t>(1, patch.size / kOffsetSamples);
  for (std::uint32_t k = 0; k < patch.size && offsets_.size() < kOffsetSamples; k += stride) {
    const auto cell = static_cast<int>(patches_.cells()[patch.first + k]);
    offsets_.push_back(grid.heights[static_cast<std::size_t>(cell)] -
                       expected(cell % geometry_.size_x, cell / geometry_.size_x));
  }
  const auto middle = offsets_.begin() + static_cast<std::ptrdiff_t>(offsets_.size() / 2);
  std::nth_element(offsets_.begin(), middle, offsets_.end());
  return *middle;
}

void ImprovedMethod::joinIslands(const FloorCells& grid, const Eigen::Vector3f& camera) {
  const auto from_home = [&](int ix, int iy) {
    return static_cast<float>(home_->at(geometry_.centreX(ix), geometry_.centreY(iy)));
  };
  const auto from_surface = [&](int ix, int iy) { return surface_.expected(ix, iy); };
  surface_.fit(floor_, grid.heights);
  home_ = near_floor_.fit(floor_, grid);
  // First what is level with the robot: it holds down the surface beside ramps.
  if (home_) {
    for (std::size_t number = 0; number < kinds_.size(); ++number) sort(number, grid, from_home);
    takeIn(PatchKind::kJoining, grid);
  }
  // Then twice what continues the surface: what joins at first carries it on to what lies behind.
  for (int round = 0; round < 2; ++round) {
    for (std::size_t number = 0; number < kinds_.size(); ++number) {
      sort(number, grid, from_surface);
      if (kinds_[number] == PatchKind::kJoining && isTop(number, camera, grid)) {
        kinds_[number] = PatchKind::kAbove;
      }
    }
    if (!takeIn(PatchKind::kJoining, grid)) return;
  }
}

/// Decides by the heights expected whether a patch that is not floor yet joins, lies above or
/// below.
template <class Expected>
void ImprovedMethod::sort(std::size_t number, const FloorCells& grid, Expected expected) {
  if (kinds_[number] == PatchKind::kFloor) return;
  const FloorPatch& patch = patches_.patches()[number];
  const float offset = patchOffset(patch, grid, expected);
  // The wobble of depth is alike over a whole patch, so it does not average out.
  const std::uint32_t middle = patches_.cells()[patch.first + patch.size / 2];
  const float tolerance = static_cast<float>(parameters_.step_height) +
                          kNoiseSigmas * std::sqrt(noise_variance_[middle]);
  kinds_[number] = std::abs(offset) <= tolerance ? PatchKind::kJoining
                   : offset > 0.0F               ? PatchKind::kAbove
                                                 : PatchKind::kBelow;
}

/// Whether the patch is the top of something: right before it, on the camera's side, stands a face.
/// Floor that something hides begins behind a shadow instead.
bool ImprovedMethod::isTop(std::size_t number, const Eigen::Vector3f& camera,
                           const FloorCells& grid) const {
  const FloorPatch& patch = patches_.patches()[number];
  int fronts = 0, faces = 0;
  for (std::uint32_t k = 0; k < patch.size; ++k) {
    const auto cell = static_cast<int>(patches_.cells()[patch.first + k]);
    const int ix = cell % geometry_.size_x, iy = cell / geometry_.size_x;
    const float dx = camera.x() - geometry_.centreX(ix), dy = camera.y() - geometry_.centreY(iy);
    const float longest = std::max(std::abs(dx), std::abs(dy));
    const int to_x = ix + static_cast<int>(std::lround(dx / longest));
    const int to_y = iy + static_cast<int>(std::lround(dy / longest));
    if (!geometry_.contains(to_x, to_y)) continue;
    const std::size_t before = geometry_.index(to_x, to_y);
    if (patches_.patchOf()[before] == static_cast<std::int32_t>(number)) continue;
    ++fronts;
    if (even_[before] == 0 && !std::isnan(grid.heights[before])) ++faces;
  }
  return 2 * faces > fronts;
}

/// Makes the patches of a kind floor; false where there are none.
bool ImprovedMethod::takeIn(PatchKind kind, const FloorCells& grid) {
  bool any = false;
  for (std::size_t number = 0; number < kinds_.size(); ++number) {
    if (kinds_[number] != kind) continue;
    any = true;
    kinds_[number] = PatchKind::kFloor;
    const FloorPatch& patch = patches_.patches()[number];
    const std::uint32_t* cells = patches_.cells().data() + patch.first;
    for (std::uint32_t k = 0; k < patch.size; ++k) floor_[cells[k]] = 1;
    surface_.add(cells, patch.size, grid.heights);
  }
  if (any) surface_.refit();
  return any;
}

/// Height of the floor at a cell: the surface round it, lowered to the floor cells that touch it,
/// so that neither a sill in the window nor the thing to be judged lifts it [m].
float ImprovedMethod::floorAt(int ix, int iy, const FloorCells& grid) {
  float lowest = 0.0F;
  for (int y = std::max(0, iy - 1); y <= std::min(geometry_.size_y - 1, iy + 1); ++y) {
    for (int x = std::max(0, ix - 1); x <= std::min(geometry_.size_x - 1, ix + 1); ++x) {
      const std::size_t i = geometry_.index(x, y);
      if (floor_[i] != 0) lowest = std::min(lowest, grid.heights[i] - surface_.expected(x, y));
    }
  }
  return surface_.expected(ix, iy) + lowest;
}

/// Whether few points of something high hide among the many of an even cell's floor.
bool ImprovedMethod::hidesRaisedPart(std::size_t i, float variance, const FloorCells& grid) {
  // The height found is largest where the cell's mean is not raised at all.
  if (variance <= kFloorSlack * (highStep() - kFloorSlack)) return false;
  const int ix = static_cast<int>(i) % geometry_.size_x;
  const int iy = static_cast<int>(i) / geometry_.size_x;
  const auto over = [&](float floor) {
    return raisedPart(grid.counts[i], std::max(0.0F, grid.heights[i] - floor), variance,
                      kFloorSlack);
  };
  // A lower floor makes the part lower, so most cells need no look at their neighbours.
  if (over(surface_.expected(ix, iy)).height <= highStep()) return false;
  const RaisedPart part = over(floorAt(ix, iy, grid));
  return part.height > highStep() && part.points >= fewestPoints() &&
         part.points < 0.5F * static_cast<float>(grid.counts[i]);
}

CellClass ImprovedMethod::judgeFloorCell(std::size_t i, const FloorCells& grid) {
  const auto threshold = static_cast<float>(parameters_.threshold_deviation);
  const float variance = grid.deviations[i] * grid.deviations[i] - noise_variance_[i];
  if (hidesRaisedPart(i, variance, grid)) return CellClass::kObstacle;
  return variance > threshold * threshold ? CellClass::kThreshold : CellClass::kFloor;
}

/// The class of a cell that is not even.
CellClass ImprovedMethod::judgeUnevenCell(std::size_t i, const FloorCells& grid) {
  const int cell = static_cast<int>(i);
  const float floor = floorAt(cell % geometry_.size_x, cell / geometry_.size_x, grid);
  const float excess = grid.heights[i] - floor;
  const float variance = grid.deviations[i] * grid.deviations[i] - noise_variance_[i];
  const RaisedPart part = raisedPart(grid.counts[i], excess, variance, 0.1F * kFloorSlack);
  const float rest = static_cast<float>(grid.counts[i]) - part.points;
  // One or two stray points do not make an obstacle, as they would not make a cell known.
  if (part.points < fewestPoints()) {
    return rest >= static_cast<float>(parameters_.min_points) ? CellClass::kFloor
                                                              : CellClass::kUnknown;
  }
  return excess < -static_cast<float>(parameters_.step_height) ? CellClass::kDropOff
                                                               : CellClass::kObstacle;
}

void ImprovedMethod::classify(FloorCells& grid) {
  const std::vector<std::int32_t>& patch_of = patches_.patchOf();
  for (std::size_t i = 0; i < grid.classes.size(); ++i) {
    if (grid.classes[i] == CellClass::kUnknown) continue;
    if (patch_of[i] < 0) {
      grid.classes[i] = judgeUnevenCell(i, grid);
      continue;
    }
    switch (kinds_[static_cast<std::size_t>(patch_of[i])]) {
      case PatchKind::kFloor:
        grid.classes[i] = judgeFloorCell(i, grid);
        break;
      case PatchKind::kBelow:
        grid.classes[i] = CellClass::kDropOff;
        break;
      case PatchKind::kAbove:
      case PatchKind::kJoining:
      case PatchKind::kUndecided:  // no floor at the robot: nothing is known to be drivable
        grid.classes[i] = CellClass::kObstacle;
        break;
    }
  }
}

/// A step down shows in more than one cell; a few points beside what stands right ahead do not
/// tell.
void ImprovedMethod::dropLoneDropOffs(FloorCells& grid) {
  for (std::size_t i = 0; i < grid.classes.size(); ++i) {
    if (grid.classes[i] != CellClass::kDropOff || grid.counts[i] >= kFewPoints) continue;
    const int ix = static_cast<int>(i) % geometry_.size_x;
    const int iy = static_cast<int>(i) / geometry_.size_x;
    int alike = 0;
    for (int y = std::max(0, iy - 1); y <= std::min(geometry_.size_y - 1, iy + 1); ++y) {
      for (int x = std::max(0, ix - 1); x <= std::min(geometry_.size_x - 1, ix + 1); ++x) {
        if (grid.classes[geometry_.index(x, y)] == CellClass::kDropOff) ++alike;
      }
    }
    if (alike == 1) grid.classes[i] = CellClass::kUnknown;  // itself
  }
}

void ImprovedMethod::markHiddenByEdge(const Eigen::Vector3f& camera, FloorCells& grid) {
  for (std::size_t i = 0; i < grid.classes.size(); ++i) {
    // Cells marked here have no height and start no walk of their own.
    if (grid.classes[i] != CellClass::kDropOff || std::isnan(grid.heights[i])) continue;
    const int cell = static_cast<int>(i);
    const auto x = static_cast<float>(cell % geometry_.size_x);
    const auto y = static_cast<float>(cell / geometry_.size_x);
    const float dx = (camera.x() - geometry_.x_min) / geometry_.cell_size - 0.5F - x;
    const float dy = (camera.y() - geometry_.y_min) / geometry_.cell_size - 0.5F - y;
    const float length = std::max(std::abs(dx), std::abs(dy));
    for (float s = 1.0F; s < length; s += 1.0F) {
      const int ix = static_cast<int>(std::lround(x + dx * s / length));
      const int iy = static_cast<int>(std::lround(y + dy * s / length));
      if (!geometry_.contains(ix, iy)) break;
      CellClass& hidden = grid.classes[geometry_.index(ix, iy)];
      if (hidden != CellClass::kUnknown) break;
      hidden = CellClass::kDropOff;
    }
  }
}

}  // namespace pilothouse
