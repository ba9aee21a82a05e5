#include <cstring>

#include "core/floor/binning_kernel.hpp"

// The definition of the sums. Every product and sum below is one rounded float operation in the
// order written (the project compiles with -ffp-contract=off); the vector kernels do the same ones.

namespace pilothouse {
namespace {

float onAxis(const BinningAxis& axis, float x, float y, float z) {
  return (axis.x * x + axis.y * y) + (axis.z * z + axis.offset);
}

void addPoint(const BinningPlan& plan, float column, float row, float step, CellMoments* cells) {
  // Written so that NaN fails every comparison.
  if (!(column >= kUnitsPerCell && column < plan.column_limit)) return;
  if (!(row >= kUnitsPerCell && row < plan.row_limit)) return;
  if (!(step <= plan.step_limit)) return;
  if (step < 0.0F) step = 0.0F;
  const auto q = static_cast<std::uint32_t>(step);
  const auto ix = static_cast<std::int32_t>(column / kUnitsPerCell) - 1;
  const auto iy = static_cast<std::int32_t>(row / kUnitsPerCell) - 1;
  CellMoments& cell = cells[static_cast<std::ptrdiff_t>(iy) * plan.size_x + ix];
  ++cell.count;
  cell.sum += q;
  cell.sum_square += std::uint64_t{q} * q;
}

float depthAt(const DepthRow& row, std::size_t u) {
  if (row.millimetres16) {
    std::uint16_t millimetres = 0;
    std::memcpy(&millimetres, row.pixels + 2 * u, sizeof(millimetres));
    return millimetres;
  }
  float metres = 0.0F;
  std::memcpy(&metres, row.pixels + 4 * u, sizeof(metres));
  return metres;
}

}  // namespace

void addCloudReference(const BinningPlan& plan, const CloudSpan& span, CellMoments* cells) {
  const std::uint8_t* point = span.first;
  for (std::size_t i = 0; i < span.points; ++i, point += span.stride) {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    std::memcpy(&x, point + span.x_offset, sizeof(x));
    std::memcpy(&y, point + span.y_offset, sizeof(y));
    std::memcpy(&z, point + span.z_offset, sizeof(z));
    addPoint(plan, onAxis(plan.column, x, y, z), onAxis(plan.row, x, y, z),
             onAxis(plan.step, x, y, z), cells);
  }
}

void addDepthReference(const BinningPlan& plan, const DepthRow& row, CellMoments* cells) {
  for (std::size_t u = 0; u < row.width; ++u) {
    const float depth = depthAt(row, u);
    if (!(depth > 0.0F)) continue;
    // Infinite depth gives an infinite or NaN coordinate, which addPoint leaves out.
    addPoint(plan, depth * (row.column_terms[0][u] + row.row_terms[0]) + plan.column.offset,
             depth * (row.column_terms[1][u] + row.row_terms[1]) + plan.row.offset,
             depth * (row.column_terms[2][u] + row.row_terms[2]) + plan.step.offset, cells);
  }
}

}  // namespace pilothouse
