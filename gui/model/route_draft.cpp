#include "gui/model/route_draft.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "doors/route_files.hpp"

namespace pilothouse::gui {

namespace {

double distanceToLeg(Eigen::Vector2d place, Eigen::Vector2d from, Eigen::Vector2d to) {
  const Eigen::Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double share =
      squared > 0.0 ? std::clamp((place - from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (place - from - share * along).norm();
}

}  // namespace

bool DraftPoint::operator==(const DraftPoint& other) const {
  return goal.place == other.goal.place && goal.heading == other.goal.heading &&
         pause == other.pause;
}

bool RouteDraft::operator==(const RouteDraft& other) const {
  return name == other.name && loop == other.loop && points == other.points;
}

double RouteDraft::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += (points[i].goal.place - points[i - 1].goal.place).norm();
  }
  if (loop && points.size() > 1)
    sum += (points.front().goal.place - points.back().goal.place).norm();
  return sum;
}

RouteDraft withPoint(RouteDraft draft, std::size_t before, const DraftPoint& point) {
  const bool sound = point.goal.place.allFinite() && draft.points.size() < RouteDraft::kMostPoints;
  if (!sound || before > draft.points.size()) return draft;
  draft.points.insert(draft.points.begin() + static_cast<std::ptrdiff_t>(before), point);
  return draft;
}

RouteDraft withoutPoint(RouteDraft draft, std::size_t index) {
  if (index >= draft.points.size()) return draft;
  draft.points.erase(draft.points.begin() + static_cast<std::ptrdiff_t>(index));
  return draft;
}

RouteDraft withPlace(RouteDraft draft, std::size_t index, Eigen::Vector2d place) {
  if (index < draft.points.size() && place.allFinite()) draft.points[index].goal.place = place;
  return draft;
}

RouteDraft withHeading(RouteDraft draft, std::size_t index, std::optional<double> heading) {
  const bool sound = !heading || std::isfinite(*heading);
  if (index < draft.points.size() && sound) draft.points[index].goal.heading = heading;
  return draft;
}

RouteDraft withPause(RouteDraft draft, std::size_t index, double seconds) {
  if (index < draft.points.size() && std::isfinite(seconds)) {
    draft.points[index].pause = std::clamp(seconds, 0.0, RouteDraft::kMostPause);
  }
  return draft;
}

RouteDraft withOrder(RouteDraft draft, std::size_t index, int by) {
  const bool earlier = by == -1 && index > 0 && index < draft.points.size();
  const bool later = by == 1 && index + 1 < draft.points.size();
  if (earlier) std::swap(draft.points[index], draft.points[index - 1]);
  if (later) std::swap(draft.points[index], draft.points[index + 1]);
  return draft;
}

RouteDraft withLoop(RouteDraft draft, bool loop) {
  draft.loop = loop;
  return draft;
}

std::optional<std::size_t> pointAfter(const RouteDraft& before, std::size_t index,
                                      const RouteDraft& after) {
  if (index >= before.points.size()) return std::nullopt;
  RouteDraft same = after;
  if (index < after.points.size()) same.points[index] = before.points[index];
  if (same.points == before.points) return index;
  const auto found = std::find(after.points.begin(), after.points.end(), before.points[index]);
  if (found == after.points.end()) return std::nullopt;
  return static_cast<std::size_t>(found - after.points.begin());
}

std::optional<std::size_t> pointAt(const RouteDraft& draft, Eigen::Vector2d place, double reach) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < draft.points.size(); ++i) {
    const double distance = (draft.points[i].goal.place - place).norm();
    if (distance > reach) continue;
    reach = distance;
    found = i;  // of several at one place the last: it is drawn on top
  }
  return found;
}

std::optional<std::size_t> legAt(const RouteDraft& draft, Eigen::Vector2d place, double reach) {
  const auto& points = draft.points;
  std::optional<std::size_t> found;
  const auto look = [&](std::size_t from, std::size_t to, std::size_t before) {
    const double distance = distanceToLeg(place, points[from].goal.place, points[to].goal.place);
    if (!(distance <= reach)) return;
    reach = distance;
    found = before;
  };
  for (std::size_t i = 1; i < points.size(); ++i) look(i - 1, i, i);
  if (draft.loop && points.size() > 2) look(points.size() - 1, 0, points.size());
  return found;
}

std::string faultOf(const RouteDraft& draft) {
  if (draft.points.empty()) return "the route has no points";
  if (draft.points.size() > RouteDraft::kMostPoints) return "the route has more than 1,000 points";
  if (draft.loop && draft.points.size() < 2) return "a loop needs two points or more";
  for (std::size_t i = 0; i < draft.points.size(); ++i) {
    const DraftPoint& point = draft.points[i];
    const bool sound = point.goal.place.allFinite() &&
                       (!point.goal.heading || std::isfinite(*point.goal.heading)) &&
                       point.pause >= 0.0 && point.pause <= RouteDraft::kMostPause;
    if (!sound) return "point " + std::to_string(i + 1) + " is not finite";
  }
  return {};
}

std::string routeNameFault(const std::string& name) {
  return pilothouse::routeNameFault(name);
}

}  // namespace pilothouse::gui
