#include "volume/volume_parameters.hpp"

#include <cmath>
#include <sstream>

namespace pilothouse {
namespace {

constexpr double kMostCells = 1 << 25;  // of the window round the camera

template <class Value>
void require(std::vector<std::string>& faults, const char* key, Value value, Value low,
             Value high) {
  if (value >= low && value <= high) return;
  std::ostringstream line;
  line << key << " is " << value << ", expected " << low << " to " << high;
  faults.push_back(line.str());
}

}  // namespace

std::vector<std::string> validate(const VolumeParameters& p) {
  std::vector<std::string> faults;
  forEachVolumeParameter(p, [&faults](const char* key, auto value, auto low, auto high) {
    require(faults, key, value, low, high);
  });
  if (!faults.empty()) return faults;
  require(faults, "occupied", p.occupied, 0.05, p.most);
  require(faults, "free", p.free, 0.05, p.most);
  const double cells =
      std::pow(2.0 * p.reach / p.voxel + 16.0, 2.0) * (p.below + p.above) / p.voxel * 4.0;
  if (cells > kMostCells) {
    std::ostringstream line;
    line << "voxel is " << p.voxel << ", too small for a reach of " << p.reach
         << " m: expected a larger one";
    faults.push_back(line.str());
  }
  return faults;
}

}  // namespace pilothouse
