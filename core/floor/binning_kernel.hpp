#pragma once

#include <cstddef>
#include <cstdint>

#include "core/floor/cell_moments.hpp"

// What the binning kernels share. Only plain data, so that a file compiled for a newer processor
// shares no inline function with the rest of the program.

namespace pilothouse {

/// Takes a point of the sensor frame to one grid coordinate: x * px + y * py + z * pz + offset.
struct BinningAxis {
  float x, y, z, offset;
};

/// One frame's arithmetic. The mounting, the cell size and the height scale are folded into three
/// axes, so that a point costs nine products:
/// - column, row: cells from the grid's edge plus one; 1 <= column < column_limit is inside,
/// - step: height steps above the scale's low, plus one half; step_limit and above it left out.
/// A kernel cuts the fraction off, and binning_reference.cpp defines the order of the operations.
struct BinningPlan {
  BinningAxis column, row, step;
  float column_limit, row_limit;  ///< cells of the axis + 1
  float step_limit;               ///< greatest step that counts
  std::int32_t size_x;
};

/// Points that follow each other every `stride` bytes, of which x, y, z (float32, in metres) lie at
/// these offsets; alignment is arbitrary.
struct CloudSpan {
  const std::uint8_t* first;
  std::size_t points;
  std::size_t stride;
  std::size_t x_offset, y_offset, z_offset;
};

/// A row of a depth image. The ray through pixel (u, v), in grid coordinates and a unit of depth,
/// is column_terms[u] + row_term; a coordinate is depth * ray + plan offset.
struct DepthRow {
  const std::uint8_t* pixels;
  std::size_t width;
  bool millimetres16;            ///< else 32-bit floats in metres
  const float* column_terms[3];  ///< of column, row, step; readable up to paddedWidth(width)
  float row_terms[3];
};

/// The vector kernels read column terms in whole vectors.
constexpr std::size_t paddedWidth(std::size_t width) {
  return (width + 15) / 16 * 16;
}

/// Partial sums of a cell. Neighbouring points mostly fall into the same cell, and adding to a sum
/// that was stored a moment ago waits for that store; so point i adds to copy i % kCopies. A copy
/// is 16 bytes { sum u32, count u32, sum_square u64 }, updated by one 128-bit load, add and store,
/// and the copies of one cell share one cache line.
struct alignas(64) CellSlot {
  static constexpr int kCopies = 4;
  struct Copy {
    std::uint32_t sum, count;
    std::uint64_t sum_square;
  } copies[kCopies];
};

/// A slot's 32-bit sums hold this many points: 2^20 * kMaxStep < 2^32.
constexpr std::size_t kMaxPointsInSlots = std::size_t{1} << 20;
static_assert(kMaxPointsInSlots * HeightScale::kMaxStep < (std::uint64_t{1} << 32));

/// Slots have a spare row and column before the first: a point below the grid's edge lands there
/// without a branch. Slot of cell (ix, iy): (iy + 1) * (size_x + 1) + ix + 1.
struct VectorKernel {
  void (*add_cloud)(const BinningPlan&, const CloudSpan&, CellSlot*);
  void (*add_depth)(const BinningPlan&, const DepthRow&, CellSlot*);
};

/// The kernels; nullptr when not built for this kind of processor. Whether the processor at hand
/// runs them is for the caller to ask.
const VectorKernel* sse4BinningKernel();
const VectorKernel* avx2BinningKernel();

/// The definition; adds to cells[iy * size_x + ix].
void addCloudReference(const BinningPlan& plan, const CloudSpan& span, CellMoments* cells);
void addDepthReference(const BinningPlan& plan, const DepthRow& row, CellMoments* cells);

}  // namespace pilothouse
