#pragma once

#include <cstring>

#include "core/floor/binning_kernel.hpp"

// The vector kernel, written once for any lane count. A file that includes this defines a struct
// Lanes over one processor's instructions and compiles for that processor. Everything here is in an
// unnamed namespace: no code for a newer processor may leak into the rest of the program.

namespace pilothouse {
namespace {

#define PILOTHOUSE_INLINE inline __attribute__((always_inline))

template <class Lanes>
class LaneBinner {
  using Float = typename Lanes::Float;
  static constexpr std::size_t kWidth = Lanes::kWidth;

 public:
  LaneBinner(const BinningPlan& plan, CellSlot* slots)
      : column_(plan.column),
        row_(plan.row),
        step_(plan.step),
        column_limit_(Lanes::all(plan.column_limit)),
        row_limit_(Lanes::all(plan.row_limit)),
        step_limit_(Lanes::all(plan.step_limit)),
        columns_(plan.size_x + 1),
        slots_(reinterpret_cast<std::uint8_t*>(slots)) {}

  void addCloud(const CloudSpan& span) const {
    std::size_t done = 0;
    if (span.y_offset == span.x_offset + 4 && span.z_offset == span.x_offset + 8) {
      // x y z and the four bytes behind come in one load. For the last point those may be behind
      // the cloud's end: it goes with the rest.
      const bool inside = span.x_offset + 16 <= span.stride;
      const std::size_t loadable = inside || span.points == 0 ? span.points : span.points - 1;
      done = loadable / kWidth * kWidth;
      const std::uint8_t* first = span.first + span.x_offset;
      if (span.stride == 16) {
        addAdjacent<16>(first, done, 16);
      } else {
        addAdjacent<0>(first, done, span.stride);
      }
    }
    addTiles(span, done);
  }

  void addDepth(const DepthRow& row) const {
    if (row.millimetres16) {
      addPixels<std::uint16_t>(row);
    } else {
      addPixels<float>(row);
    }
  }

 private:
  struct Axis {
    explicit Axis(const BinningAxis& axis)
        : x(Lanes::all(axis.x)),
          y(Lanes::all(axis.y)),
          z(Lanes::all(axis.z)),
          offset(Lanes::all(axis.offset)) {}
    PILOTHOUSE_INLINE Float of(Float px, Float py, Float pz) const {
      return (x * px + y * py) + (z * pz + offset);
    }
    Float x, y, z, offset;
  };

  template <std::size_t kStride>
  PILOTHOUSE_INLINE void addAdjacent(const std::uint8_t* first, std::size_t points,
                                     std::size_t stride) const {
    for (std::size_t i = 0; i < points; i += kWidth) {
      Float x, y, z;
      Lanes::template loadPoints<kStride>(first + i * stride, stride, x, y, z);
      addPoints(x, y, z);
    }
  }

  /// Any other layout, and the points left over: through a small tile of coordinates. A whole tile
  /// at a time, because a vector load right behind the scalar stores it covers would stall.
  void addTiles(const CloudSpan& span, std::size_t begin) const {
    constexpr std::size_t kTile = 64;
    alignas(32) float tile[3][kTile];
    const std::size_t offsets[3] = {span.x_offset, span.y_offset, span.z_offset};
    for (std::size_t i = begin; i < span.points; i += kTile) {
      const std::size_t count = span.points - i < kTile ? span.points - i : kTile;
      const std::size_t padded = (count + kWidth - 1) / kWidth * kWidth;
      for (int axis = 0; axis < 3; ++axis) {
        const std::uint8_t* from = span.first + i * span.stride + offsets[axis];
        for (std::size_t k = 0; k < count; ++k, from += span.stride) {
          std::memcpy(&tile[axis][k], from, sizeof(float));
        }
        for (std::size_t k = count; k < padded; ++k) tile[axis][k] = __builtin_nanf("");
      }
      for (std::size_t k = 0; k < padded; k += kWidth) {
        addPoints(Lanes::load(&tile[0][k]), Lanes::load(&tile[1][k]), Lanes::load(&tile[2][k]));
      }
    }
  }

  template <class Pixel>
  PILOTHOUSE_INLINE void addPixels(const DepthRow& row) const {
    const Float v_column = Lanes::all(row.row_terms[0]);
    const Float v_row = Lanes::all(row.row_terms[1]);
    const Float v_step = Lanes::all(row.row_terms[2]);
    const auto addVector = [&](const std::uint8_t* pixels, std::size_t u)
        __attribute__((always_inline)) {
      const Float depth = Lanes::loadDepth(pixels, Pixel{});
      add(depth * (Lanes::load(row.column_terms[0] + u) + v_column) + column_.offset,
          depth * (Lanes::load(row.column_terms[1] + u) + v_row) + row_.offset,
          depth * (Lanes::load(row.column_terms[2] + u) + v_step) + step_.offset,
          Lanes::isPositive(depth));
    };
    const std::size_t whole = row.width / kWidth * kWidth;
    for (std::size_t u = 0; u < whole; u += kWidth) {
      addVector(row.pixels + u * sizeof(Pixel), u);
    }
    if (whole < row.width) {
      std::uint8_t rest[kWidth * sizeof(Pixel)] = {};  // depth 0: no measurement
      std::memcpy(rest, row.pixels + whole * sizeof(Pixel), (row.width - whole) * sizeof(Pixel));
      addVector(rest, whole);
    }
  }

  PILOTHOUSE_INLINE void addPoints(Float x, Float y, Float z) const {
    add(column_.of(x, y, z), row_.of(x, y, z), step_.of(x, y, z), Lanes::allTrue());
  }

  PILOTHOUSE_INLINE void add(Float column, Float row, Float step, Float valid) const {
    // NaN fails these. What lies below an edge is clamped onto the spare row or column instead.
    const Float keep = Lanes::both(
        Lanes::both(valid, Lanes::notAbove(step, step_limit_)),
        Lanes::both(Lanes::below(column, column_limit_), Lanes::below(row, row_limit_)));
    // Rows of the picture above the horizon or beyond the range come in long runs.
    if (Lanes::noneTrue(keep)) return;
    const Float zero = Lanes::all(0.0F);
    const auto ix = Lanes::cut(Lanes::greater(column, zero));
    const auto iy = Lanes::cut(Lanes::greater(row, zero));
    const auto q = Lanes::cut(Lanes::lesser(Lanes::greater(step, zero),
                                            Lanes::all(static_cast<float>(HeightScale::kMaxStep))));
    // Left out: slot 0.
    Lanes::addToSlots(Lanes::masked(Lanes::slotOffset(ix, iy, columns_), keep), q, slots_);
  }

  Axis column_, row_, step_;
  Float column_limit_, row_limit_, step_limit_;
  std::int32_t columns_;
  std::uint8_t* slots_;
};

template <class Lanes>
void addCloudLanes(const BinningPlan& plan, const CloudSpan& span, CellSlot* slots) {
  LaneBinner<Lanes>(plan, slots).addCloud(span);
}

template <class Lanes>
void addDepthLanes(const BinningPlan& plan, const DepthRow& row, CellSlot* slots) {
  LaneBinner<Lanes>(plan, slots).addDepth(row);
}

}  // namespace
}  // namespace pilothouse
