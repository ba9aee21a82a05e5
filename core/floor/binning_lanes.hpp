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
  using Int = typename Lanes::Int;
  static constexpr std::size_t kWidth = Lanes::kWidth;

 public:
  LaneBinner(const BinningPlan& plan, BinningSums& sums)
      : column_(plan.column),
        row_(plan.row),
        step_(plan.step),
        column_limit_(Lanes::all(plan.column_limit)),
        step_limit_(Lanes::all(plan.step_limit)),
        size_limits_(Lanes::pairs(plan.size_x + 1, plan.size_y + 1)),
        slot_weights_(Lanes::pairs(CellSlot::kCopies, (plan.size_x + 2) * CellSlot::kCopies)),
        one_point_(Lanes::all32(unknown(kOnePoint))),
        slot_columns_(static_cast<std::uint32_t>(plan.size_x) + 2),
        slot_rows_(static_cast<std::uint32_t>(plan.size_y) + 2),
        slots_(reinterpret_cast<std::uint64_t*>(sums.slots)),
        sums_(sums) {}

  void addCloud(CloudSpan span) {
    if (span.y_offset == span.x_offset + 4 && span.z_offset == span.x_offset + 8) {
      addTiles(takeFirst(span, pointsBeforeAlignment(span)));
      // x y z and the four bytes behind come in one load. For the last point those may be behind
      // the cloud's end: it goes with the rest.
      const bool inside = span.x_offset + 16 <= span.stride;
      const std::size_t loadable = inside || span.points == 0 ? span.points : span.points - 1;
      const CloudSpan whole = takeFirst(span, loadable / kWidth * kWidth);
      const std::uint8_t* first = whole.first + whole.x_offset;
      if (span.stride == 16) {
        addAdjacent<16>(first, whole.points, 16);
      } else if (span.stride == 32) {
        addAdjacent<32>(first, whole.points, 32);
      } else {
        addAdjacent<0>(first, whole.points, span.stride);
      }
    }
    addTiles(span);
    finish();
  }

  void addDepth(const DepthRow& row) {
    if (row.millimetres16) {
      addPixels<std::uint16_t>(row);
    } else {
      addPixels<float>(row);
    }
    finish();
  }

 private:
  /// Upper half of the sum of a point at step 0.
  static constexpr std::uint32_t kOnePoint = 1U << (CellSlot::kCountBit - CellSlot::kStepBit);

  /// Keeps the compiler from making a constant anew for every vector.
  template <class T>
  static PILOTHOUSE_INLINE T unknown(T value) {
    asm("" : "+r"(value));
    return value;
  }

  /// The sums of one vector on their way to the slots. They go through memory: scalar loads are
  /// cheaper than extractions, and the additions then use none of the vector units.
  struct Pending {
    alignas(32) std::uint32_t at[kWidth];  ///< slot * kCopies
    alignas(32) std::uint64_t value[kWidth];
    std::size_t first_copy;
  };

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

  static CloudSpan takeFirst(CloudSpan& span, std::size_t count) {
    CloudSpan taken = span;
    taken.points = count;
    span.first += count * span.stride;
    span.points -= count;
    return taken;
  }

  /// Allocators align to 16 bytes, so that every other load of two points would straddle two cache
  /// lines.
  static std::size_t pointsBeforeAlignment(const CloudSpan& span) {
    const std::size_t behind = reinterpret_cast<std::uintptr_t>(span.first + span.x_offset) % 32;
    return span.stride == 16 && behind == 16 && span.points > 0 ? 1 : 0;
  }

  /// @tparam kStride the stride when it is known beforehand, else 0.
  template <std::size_t kStride>
  PILOTHOUSE_INLINE void addAdjacent(const std::uint8_t* first, std::size_t points,
                                     std::size_t any_stride) {
    const std::size_t stride = kStride != 0 ? kStride : any_stride;
    // A cloud is larger than the near caches, and the additions below leave the processor no room
    // to look far enough ahead by itself. Prefetching behind the cloud's end does no harm.
    constexpr std::size_t kAhead = 2048, kCacheLine = 64;
    for (std::size_t i = 0; i < points; i += kWidth) {
      const std::uint8_t* from = first + i * stride;
      for (std::size_t byte = 0; byte < kWidth * stride; byte += kCacheLine) {
        __builtin_prefetch(from + byte + kAhead);
      }
      Float x, y, z;
      Lanes::template loadPoints<kStride>(from, stride, x, y, z);
      addPoints(x, y, z, i);
    }
  }

  /// Any other layout, and the points left over: through a small tile of coordinates. A whole tile
  /// at a time, because a vector load right behind the scalar stores it covers would stall.
  void addTiles(const CloudSpan& span) {
    constexpr std::size_t kTile = 64;
    alignas(32) float tile[3][kTile];
    const std::size_t offsets[3] = {span.x_offset, span.y_offset, span.z_offset};
    for (std::size_t i = 0; i < span.points; i += kTile) {
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
        addPoints(Lanes::load(&tile[0][k]), Lanes::load(&tile[1][k]), Lanes::load(&tile[2][k]), k);
      }
    }
  }

  template <class Pixel>
  PILOTHOUSE_INLINE void addPixels(const DepthRow& row) {
    const Float v_column = Lanes::all(row.row_terms[0]);
    const Float v_row = Lanes::all(row.row_terms[1]);
    const Float v_step = Lanes::all(row.row_terms[2]);
    const float* terms[3] = {row.column_terms[0], row.column_terms[1], row.column_terms[2]};
    const std::uint8_t* row_pixels = row.pixels;
    const auto addVector = [&](const std::uint8_t* pixels, std::size_t u)
        __attribute__((always_inline)) {
      const Float depth = Lanes::loadDepth(pixels, Pixel{});
      const auto onAxis = [&](int axis, Float row_term, Float offset)
          __attribute__((always_inline)) {
        return depth * (Lanes::load(terms[axis] + u) + row_term) + offset;
      };
      const Float step = onAxis(2, v_step, step_.offset);
      const Float keep = Lanes::both(Lanes::isPositive(depth), Lanes::notAbove(step, step_limit_));
      add(onAxis(0, v_column, column_.offset), onAxis(1, v_row, row_.offset), step, keep, u);
    };
    const std::size_t whole = row.width / kWidth * kWidth;
    for (std::size_t u = 0; u < whole; u += kWidth) {
      addVector(row_pixels + u * sizeof(Pixel), u);
    }
    if (whole < row.width) {
      std::uint8_t rest[kWidth * sizeof(Pixel)] = {};  // depth 0: no measurement
      std::memcpy(rest, row.pixels + whole * sizeof(Pixel), (row.width - whole) * sizeof(Pixel));
      addVector(rest, whole);
    }
  }

  PILOTHOUSE_INLINE void addPoints(Float x, Float y, Float z, std::size_t copy) {
    const Float step = step_.of(x, y, z);
    add(column_.of(x, y, z), row_.of(x, y, z), step, Lanes::notAbove(step, step_limit_), copy);
  }

  /// @param copy multiple of kWidth that changes from vector to vector.
  PILOTHOUSE_INLINE void add(Float column, Float row, Float step, Float keep, std::size_t copy) {
    // NaN fails the comparison.
    keep = Lanes::both(keep, Lanes::below(column, column_limit_));
    // Rows of the picture above the horizon or beyond the range come in long runs.
    if (Lanes::noneTrue(keep)) return;
    const Int q = Lanes::cut(Lanes::greater(step, Lanes::all(0.0F)));
    // As unsigned 16-bit numbers, cells below the edge, beyond it and the overflow of a conversion
    // are all above the limit, which is the spare cell. What keep leaves out gets slot 0.
    const Int cells =
        Lanes::lesser16(Lanes::upperHalves(Lanes::cut(column), Lanes::cut(row)), size_limits_);
    const Int slot = Lanes::masked(Lanes::sumOfProducts16(cells, slot_weights_), keep);
    // The vector before is added while this one's products are under way.
    Pending& pending = pending_[turn_];
    turn_ ^= 1;
    Lanes::store(pending.at, slot);
    Lanes::storePacked(pending.value, q, Lanes::either(q, one_point_));
    pending.first_copy = copy % CellSlot::kCopies;
    asm("" : "+m"(pending_));  // keeps the compiler from extracting lanes from registers after all
    addToSlots(pending_[turn_]);
  }

  /// Adds what the last vector left.
  void finish() { addToSlots(pending_[turn_ ^ 1]); }

  PILOTHOUSE_INLINE void addToSlots(const Pending& pending) {
    std::uint64_t* copies = slots_ + (kWidth < CellSlot::kCopies ? pending.first_copy : 0);
    std::uint64_t any_full = 0;
#pragma GCC unroll 8
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      // storePacked puts the even lanes first.
      const std::size_t from = lane / 2 + lane % 2 * (kWidth / 2);
      const std::uint64_t sum = copies[pending.at[lane] + lane] + pending.value[from];
      copies[pending.at[lane] + lane] = sum;
      any_full |= sum;
    }
    if (__builtin_expect(static_cast<std::int64_t>(any_full) < 0, 0)) {
      spill(pending.at, copies, slot_columns_, slot_rows_, sums_);
    }
  }

  /// Moves the full ones of the sums that a vector added to; a spare slot's are dropped.
  __attribute__((noinline, cold)) static void spill(const std::uint32_t* at, std::uint64_t* copies,
                                                    std::uint32_t slot_columns,
                                                    std::uint32_t slot_rows, BinningSums& sums) {
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      std::uint64_t& sum = copies[at[lane] + lane];
      if (sum >> CellSlot::kCountBit < CellSlot::kFullCount) continue;
      const std::uint32_t slot = at[lane] / CellSlot::kCopies;
      const std::uint32_t ix = slot % slot_columns, iy = slot / slot_columns;
      if (ix > 0 && iy > 0 && ix + 1 < slot_columns && iy + 1 < slot_rows) {
        addUnpacked(sum, sums.spilled[slot]);
        sums.any_spilled = true;
      }
      sum = 0;
    }
  }

  static void addUnpacked(std::uint64_t sum, CellMoments& moments) {
    const std::uint64_t upper = sum >> CellSlot::kStepBit;
    moments.count += static_cast<std::uint32_t>(upper / kOnePoint);
    moments.sum += upper % kOnePoint;
    moments.sum_square += sum % (std::uint64_t{1} << CellSlot::kStepBit);
  }

  Pending pending_[2] = {};  // nothing for slot 0, which is spare
  unsigned turn_ = 0;
  Axis column_, row_, step_;
  Float column_limit_, step_limit_;
  Int size_limits_, slot_weights_;
  Int one_point_;
  std::uint32_t slot_columns_, slot_rows_;
  std::uint64_t* slots_;
  BinningSums& sums_;
};

template <class Lanes>
void addCloudLanes(const BinningPlan& plan, const CloudSpan& span, BinningSums& sums) {
  LaneBinner<Lanes>(plan, sums).addCloud(span);
}

template <class Lanes>
void addDepthLanes(const BinningPlan& plan, const DepthRow& row, BinningSums& sums) {
  LaneBinner<Lanes>(plan, sums).addDepth(row);
}

}  // namespace
}  // namespace pilothouse
