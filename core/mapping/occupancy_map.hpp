#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/mapping/map_cell_state.hpp"
#include "core/mapping/map_cells.hpp"
#include "core/mapping/occupancy_parameters.hpp"
#include "core/mapping/planar_scan.hpp"
#include "core/motion/local_memory.hpp"
#include "core/motion/obstacle.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse {

/// A cell of the endless grid of a map.
struct CellPlace {
  std::int32_t ix = 0, iy = 0;
};

/// Log-odds grid in the map frame (Moravec and Elfes, High Resolution Maps from Wide Angle Sonar,
/// ICRA 1985; log-odds after Thrun, Burgard and Fox, Probabilistic Robotics, 9.2), fed frame by
/// frame; each cell learns once from each frame. Grows in blocks, where something was seen and
/// round the robot, within the square that its parameters name. Allocates only where it grows. One
/// thread at a time.
class OccupancyMap {
 public:
  static constexpr int kBlock = 16;  ///< cells a side of a block
  using Block = std::array<MapCellState, static_cast<std::size_t>(kBlock) * kBlock>;

  /// @throws std::invalid_argument listing every fault of the parameters.
  explicit OccupancyMap(const OccupancyParameters& parameters);
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;
  ~OccupancyMap();
  /// For who takes his time with it while this one learns on.
  OccupancyMap copy() const;

  // In: each returns why the frame was refused, and then nothing has changed; null: it was not.
  // The pose is the base's in the map frame at the frame's stamp.

  /// Floor clears; thresholds and drop-offs are kept as such; obstacles count as passing. Something
  /// occupied is not cleared by floor behind which nothing is seen: that may be its foot.
  const char* addFloor(const FloorFrame& frame, const Pose2& T_map_base);
  /// Each beam clears the cells before its end, and marks that one.
  const char* addScan(const PlanarScan& scan, const Pose2& T_map_base);
  /// Discs of the base frame that stay: obstacles, thresholds and drop-offs mark the cells whose
  /// centres they cover, and the one that they lie in.
  const char* addObjects(const std::vector<Obstacle>& objects, const Pose2& T_map_base);
  /// These cells are taken for this from now on, as surely as can be.
  void set(const std::vector<CellPlace>& places, MapCell judged);
  void clear();

  // Out.

  MapCellState state(CellPlace place) const;
  MapCell at(CellPlace place) const { return rule_.judge(state(place)); }
  /// The cell of a place of the map frame [m]; it must be finite and within 1e6 m.
  CellPlace cellOf(double x, double y) const;
  Eigen::Vector2d centreOf(CellPlace place) const;
  /// Everything known, judged; reuses the memory of `out`.
  void snapshot(MapCells& out) const;
  /// Another number where a cell is judged otherwise than before.
  std::uint32_t version() const { return version_; }
  /// Cells that were not learnt because they lie outside of the map's square.
  std::uint64_t refusedCells() const { return refused_cells_; }
  std::size_t blockCount() const { return block_count_; }
  const OccupancyParameters& parameters() const { return parameters_; }

  // For files: where the grid's lines run, and its blocks as they are.

  /// Lower left corner of cell (0, 0) [m]; below a cell's size.
  const Eigen::Vector2d& anchor() const { return anchor_; }
  /// Before anything was learnt.
  void setAnchor(const Eigen::Vector2d& anchor) { anchor_ = anchor; }
  /// Calls visit(column, row, block) for each, row by row; its first cell is (16 column, 16 row).
  void forEachBlock(const std::function<void(int, int, const Block&)>& visit) const;
  /// @return the block, made where it was not; null where it would leave the map's square.
  Block* ensureBlock(int column, int row);
  /// Everything may have changed: after writing to blocks.
  void touched() { ++version_; }

 private:
  const char* begin(const Pose2& T_map_base);
  /// The map reaches round the robot, though its camera does not see where it stands.
  void reachRound(const Pose2& pose);
  void markFloor(const FloorFrame& frame, const Pose2& pose);
  void lookAtFloor(const FloorFrame& frame, const Pose2& pose);
  void markDisc(const Obstacle& object, const Eigen::Vector2d& centre);
  void note(std::int32_t ix, std::int32_t iy, CellEvidence evidence);
  /// @param keeps called for occupied cells that were seen free: true: they stay as they are.
  template <class Keeps>
  void learn(Keeps keeps);
  template <class Keeps>
  void learnBlock(int column, int row, std::uint8_t* evidence, Keeps keeps);
  const Block* block(int column, int row) const;
  /// Block of a cell, also of a negative one.
  static int blockOf(std::int32_t cell) {
    return cell >= 0 ? cell / kBlock : -((kBlock - 1 - cell) / kBlock);
  }
  bool inside(int column, int row) const {
    return column >= -half_ && column < half_ && row >= -half_ && row < half_;
  }
  std::size_t slot(int column, int row) const {
    return static_cast<std::size_t>(row + half_) * static_cast<std::size_t>(2 * half_) +
           static_cast<std::size_t>(column + half_);
  }

  OccupancyParameters parameters_;
  CellRule rule_;
  Eigen::Vector2d anchor_{0.0, 0.0};
  int half_ = 0;                                ///< the square reaches +-half blocks
  std::vector<std::unique_ptr<Block>> blocks_;  ///< by slot; null: nothing was seen there
  std::size_t block_count_ = 0;
  std::uint32_t version_ = 0;
  std::uint64_t refused_cells_ = 0;

  // What one frame says of the cells round the robot, before it is learnt.
  int side_ = 0;                              ///< cells, a multiple of kBlock
  std::int32_t window_x_ = 0, window_y_ = 0;  ///< its first cell, at a block's corner
  std::vector<std::uint8_t> evidence_;        ///< CellEvidence a cell; all none between frames
  std::int32_t low_x_ = 0, low_y_ = 0, high_x_ = -1, high_y_ = -1;  ///< touched part, in blocks
};

}  // namespace pilothouse
