#include "core/motion/parameter_ranges.hpp"

#include <cmath>
#include <sstream>

namespace pilothouse {
namespace {

template <class T>
std::string line(const char* key, T value, T low, T high) {
  std::ostringstream text;
  text << key << " is " << value << ", expected " << low << " to " << high;
  return text.str();
}

/// Collects what is out of its range; NaN is.
struct OutOfRange {
  std::vector<std::string>& faults;
  template <class T>
  void operator()(const char* key, const T& value, T low, T high) {
    if (!(value >= low && value <= high)) faults.push_back(line(key, value, low, high));
  }
};

}  // namespace

std::vector<std::string> validate(const BaseParameters& p) {
  std::vector<std::string> faults;
  forEachBaseParameter(p, OutOfRange{faults});
  if (faults.empty() && p.kind != BaseKind::kDifferential && !(p.wheelbase >= 0.02)) {
    faults.push_back(line("wheelbase", p.wheelbase, 0.02, 5.0));
  }
  return faults;
}

std::vector<std::string> validate(const AvoidanceParameters& p) {
  std::vector<std::string> faults;
  forEachAvoidanceParameter(p, OutOfRange{faults});
  if (faults.empty() && p.confirm_frames > p.confirm_of) {
    faults.push_back(line("confirm_frames", p.confirm_frames, 1, p.confirm_of));
  }
  return faults;
}

}  // namespace pilothouse
