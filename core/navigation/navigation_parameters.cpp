#include "core/navigation/navigation_parameters.hpp"

#include <sstream>

namespace pilothouse {

std::vector<std::string> validate(const NavigationParameters& p) {
  std::vector<std::string> faults;
  forEachNavigationParameter(
      p, [&faults](const char* key, const auto& value, const auto& low, const auto& high) {
        if (value >= low && value <= high) return;
        std::ostringstream text;
        text << key << " is " << value << ", expected " << low << " to " << high;
        faults.push_back(text.str());
      });
  return faults;
}

}  // namespace pilothouse
