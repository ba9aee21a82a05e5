#pragma once

#include <pilothouse/FloorGrid.h>

#include <vector>

namespace pilothouse {

/// Finds a camera that sends the same picture again under new stamps. What a sensor measures is
/// never the same twice: the spread of the heights in a grid's cells comes from its noise.
class FrozenGrid {
 public:
  /// True where every cell spreads as in the grid before, to the last bit, and not all alike, as
  /// they would without a sensor's noise.
  bool repeats(const FloorGrid& grid);

 private:
  std::vector<float> before_;
};

}  // namespace pilothouse
