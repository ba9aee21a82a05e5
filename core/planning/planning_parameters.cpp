#include "core/planning/planning_parameters.hpp"

#include <sstream>

namespace pilothouse {

std::vector<std::string> validate(const PlanningParameters& p) {
  std::vector<std::string> faults;
  forEachPlanningParameter(p, [&faults](const char* key, double value, double low, double high) {
    if (value >= low && value <= high) return;
    std::ostringstream text;
    text << key << " is " << value << ", expected " << low << " to " << high;
    faults.push_back(text.str());
  });
  return faults;
}

}  // namespace pilothouse
