#include "core/tasks/route_faults.hpp"

#include <cmath>
#include <sstream>

namespace pilothouse {

std::string faultOfStops(const Wish& wish) {
  std::ostringstream text;
  if (wish.stops.empty()) return "no points, expected at least one";
  if (wish.stops.size() > kMostStops) {
    text << wish.stops.size() << " points, expected at most " << kMostStops;
    return text.str();
  }
  for (std::size_t i = 0; i < wish.stops.size(); ++i) {
    const RouteStop& stop = wish.stops[i];
    const auto& place = stop.goal.place;
    text << "point " << i << ": ";
    if (!(std::abs(place.x()) <= kFarthestStop && std::abs(place.y()) <= kFarthestStop)) {
      text << "place is " << place.x() << " " << place.y() << ", expected within " << kFarthestStop
           << " m";
      return text.str();
    }
    if (stop.goal.heading && !std::isfinite(*stop.goal.heading)) {
      text << "heading is " << *stop.goal.heading << ", expected a finite angle or none";
      return text.str();
    }
    if (!(stop.pause >= 0.0 && stop.pause <= kLongestPause)) {
      text << "pause is " << stop.pause << ", expected 0 to " << kLongestPause << " s";
      return text.str();
    }
    text.str("");
  }
  return {};
}

}  // namespace pilothouse
