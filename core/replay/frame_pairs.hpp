#pragma once

#include <string>
#include <vector>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// File names of one picture of a depth camera. `colour` is empty where there is none.
struct FramePair {
  std::string depth;
  std::string colour;
};

/// Pairs STEM_depth.png with STEM_color.png, in the order of their names; other names are left
/// aside. Refused: no depth file at all.
Checked<std::vector<FramePair>> pairFrames(const std::vector<std::string>& names);

}  // namespace pilothouse
