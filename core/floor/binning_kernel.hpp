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

/// Grid coordinates count in 1/65536 of a cell, so that the whole cell is the upper half of a
/// 32-bit number.
constexpr float kUnitsPerCell = 65536.0F;

/// One frame's arithmetic. The mounting, the cell size and the height scale are folded into three
/// axes, so that a point costs nine products:
/// - column, row: units from the grid's edge plus one cell; from kUnitsPerCell on and below the
///   limit is inside,
/// - step: height steps above the scale's low, plus one half; above step_limit is left out.
/// A kernel cuts the fraction off, and binning_reference.cpp defines the order of the operations.
struct BinningPlan {
  BinningAxis column, row, step;
  float column_limit, row_limit;  ///< (cells of the axis + 1) * kUnitsPerCell
  float step_limit;               ///< greatest step that counts
  std::int32_t size_x, size_y;
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

/// Partial sums of a cell, of which the vector kernels keep several copies. A sum packs
///   bits 0..31 squared steps, bits 32..51 steps, bits 55..62 count,
/// so that a point is one addition to one word in memory. Bit 63 appears with the 256th point, when
/// every field still fits: then the sum moves to the spilled moments.
/// Neighbouring points mostly fall into the same cell, and adding to a word that was stored a
/// moment ago waits for that store; so point i adds to copy i % kCopies. They share one cache line.
struct alignas(64) CellSlot {
  static constexpr int kCopies = 8;
  static constexpr int kStepBit = 32, kCountBit = 55;
  static constexpr std::uint64_t kFullCount = 256;
  std::uint64_t copies[kCopies];
};
static_assert(CellSlot::kFullCount << CellSlot::kCountBit == std::uint64_t{1} << 63);
static_assert(CellSlot::kFullCount * HeightScale::kMaxStep * HeightScale::kMaxStep <
              std::uint64_t{1} << CellSlot::kStepBit);
// A whole slot's steps fit as well, so that its copies can be added up without unpacking this
// field.
static_assert(CellSlot::kCopies * CellSlot::kFullCount * HeightScale::kMaxStep <
              std::uint64_t{1} << (CellSlot::kCountBit - CellSlot::kStepBit));

/// What a vector kernel adds to. A spare row and column at either side take the points outside
/// without a branch: slot of cell (ix, iy) is (iy + 1) * (size_x + 2) + ix + 1.
struct BinningSums {
  CellSlot* slots;
  CellMoments* spilled;  ///< for each slot
  bool any_spilled;      ///< from a slot that is not spare
};

/// The slot's number is a sum of 16-bit products.
constexpr std::int32_t kMaxVectorSizeX = 4000, kMaxVectorSizeY = 32000;

struct VectorKernel {
  void (*add_cloud)(const BinningPlan&, const CloudSpan&, BinningSums&);
  void (*add_depth)(const BinningPlan&, const DepthRow&, BinningSums&);
};

/// The kernels; nullptr when not built for this kind of processor. Whether the processor at hand
/// runs them is for the caller to ask.
const VectorKernel* sse4BinningKernel();
const VectorKernel* avx2BinningKernel();

/// The definition; adds to cells[iy * size_x + ix].
void addCloudReference(const BinningPlan& plan, const CloudSpan& span, CellMoments* cells);
void addDepthReference(const BinningPlan& plan, const DepthRow& row, CellMoments* cells);

}  // namespace pilothouse
