#include "core/mapping/occupancy_parameters.hpp"

#include <sstream>

namespace pilothouse {
namespace {

constexpr double kMostCells = 20000.0;  // a side

void require(std::vector<std::string>& faults, const char* key, double value, double low,
             double high) {
  if (value >= low && value <= high) return;
  std::ostringstream line;
  line << key << " is " << value << ", expected " << low << " to " << high;
  faults.push_back(line.str());
}

}  // namespace

std::vector<std::string> validate(const OccupancyParameters& p) {
  std::vector<std::string> faults;
  forEachOccupancyParameter(p, [&faults](const char* key, double value, double low, double high) {
    require(faults, key, value, low, high);
  });
  if (!faults.empty()) return faults;
  require(faults, "max_side", p.max_side, 1.0, kMostCells * p.cell_size);
  require(faults, "reach", p.reach, 0.5, 1000.0 * p.cell_size);
  require(faults, "occupied", p.occupied, 0.05, p.most);
  require(faults, "free", p.free, 0.05, p.most);
  require(faults, "passing", p.passing, 0.0, p.most);
  return faults;
}

}  // namespace pilothouse
