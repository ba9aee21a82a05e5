#include "gui/model/route_preview.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::gui {

namespace {

constexpr std::uint32_t kOurs = 0x80000000U;  // no ask for a single goal has such an id

bool same(const std::optional<Pose2>& a, const std::optional<Pose2>& b) {
  if (!a || !b) return !a && !b;
  return a->x == b->x && a->y == b->y && a->heading == b->heading;
}

bool same(const PlaceGoal& a, const PlaceGoal& b) {
  return a.place == b.place && a.heading == b.heading;
}

/// Where any heading will do the robot is taken to come on the way to the next point.
Pose2 startAt(const PlaceGoal& goal, const PlaceGoal& next) {
  const Eigen::Vector2d way = next.place - goal.place;
  return {goal.place.x(), goal.place.y(), goal.heading.value_or(std::atan2(way.y(), way.x()))};
}

}  // namespace

std::vector<RoutePreview::Leg> RoutePreview::legsOf(const RouteDraft& draft) {
  std::vector<Leg> legs;
  const std::size_t count = draft.points.size();
  const std::size_t wanted = count + (draft.loop && count > 1 ? 1 : 0);
  for (std::size_t i = 0; i < std::min(wanted, kMostLegs); ++i) {
    Leg leg;
    leg.to = draft.points[i % count].goal;
    if (i > 0) leg.from = startAt(draft.points[i - 1].goal, leg.to);
    legs.push_back(leg);
  }
  return legs;
}

void RoutePreview::follow(const RouteDraft& draft, double now) {
  if (draft == draft_) return;
  draft_ = draft;
  changed_at_ = now;
  // Its answer counts no more: it is asked again.
  if (under_way_) legs_[*under_way_].planned_at = kNever;
  under_way_.reset();
  const std::vector<Leg> before = std::move(legs_);
  legs_ = legsOf(draft);
  for (Leg& leg : legs_) {
    const auto known = std::find_if(before.begin(), before.end(), [&](const Leg& old) {
      return same(old.from, leg.from) && same(old.to, leg.to);
    });
    if (known != before.end()) leg = *known;
  }
}

std::optional<LegAsk> RoutePreview::due(double now) {
  if (now - changed_at_ < kRest || now - asked_at_ < kAskEvery) return std::nullopt;
  if (under_way_ && now - asked_at_ < kPatience) return std::nullopt;
  // Those without a way first, then the oldest.
  const auto oldest = std::min_element(legs_.begin(), legs_.end(), [](const Leg& a, const Leg& b) {
    return a.planned_at < b.planned_at;
  });
  if (oldest == legs_.end() || now - oldest->planned_at < kAgain) return std::nullopt;
  oldest->planned_at = asked_at_ = now;
  under_way_ = static_cast<std::size_t>(oldest - legs_.begin());
  asked_ = kOurs | (asked_ + 1);
  return LegAsk{asked_, oldest->from, oldest->to};
}

bool RoutePreview::answered(const std::shared_ptr<const Preview>& preview) {
  if (!preview || !under_way_ || preview->id != asked_) return false;
  legs_[*under_way_].answer = preview;
  under_way_.reset();
  return true;
}

const Preview* RoutePreview::legTo(std::size_t point) const {
  return point < legs_.size() ? legs_[point].answer.get() : nullptr;
}

RoutePreview::Sum RoutePreview::sum() const {
  Sum sum;
  const std::size_t count = draft_.points.size();
  sum.complete = count > 0 && legs_.size() == count + (draft_.loop && count > 1 ? 1 : 0);
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Preview* way = legs_[i].answer.get();
    const bool found = way && way->found;
    sum.complete = sum.complete && found;
    if (way && way->answered && !way->found && !sum.blocked) sum.blocked = i;
    if (!found) continue;
    sum.length += way->path.length;
    sum.time += way->time;
  }
  for (const DraftPoint& point : draft_.points) sum.time += point.pause;
  return sum;
}

}  // namespace pilothouse::gui
