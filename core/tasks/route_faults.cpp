#include "core/tasks/route_faults.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pilothouse {
namespace {

constexpr double kApart = 0.05;  // [m]

/// A loop without would turn on the spot for ever.
bool hasTwoPlaces(const Wish& wish) {
  return std::any_of(wish.stops.begin(), wish.stops.end(), [&wish](const RouteStop& stop) {
    return (stop.goal.place - wish.stops.front().goal.place).norm() > kApart;
  });
}

}  // namespace

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
  if (wish.loop && !hasTwoPlaces(wish)) {
    text << "loop: its points lie in one place, expected two that are " << kApart << " m apart";
    return text.str();
  }
  return {};
}

}  // namespace pilothouse
