#include "gui/view/route_tool.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/model/clock.hpp"

namespace pilothouse::gui {

namespace {
constexpr double kTurn = 15.0 / 57.29577951308232;  // rad a key
constexpr double kPatience = 3.0;                   // s with the list of what is kept
constexpr double kSamePlace = 0.02;                 // m
// Steps that grow into one, by the point they are about.
constexpr int kMoves = 10000, kTurns = 20000, kPauses = 30000;
}  // namespace

RouteTool::RouteTool(const PlaceState& state, AskPlace ask, Footprint outline)
    : state_(state), ask_(std::move(ask)), outline_(std::move(outline)) {
  const auto shelf = state_.shelf.get();
  if (shelf) shelf_ = shelf->serial;
  connect(&history_, &RouteHistory::changed, this, &RouteTool::follow);
}

// The choice and the cross go where the chosen point goes, also when a step is taken back.
void RouteTool::follow(const RouteDraft& before) {
  if (selected_) selected_ = pointAfter(before, *selected_, draft());
  if (selected_) cross_ = draft().points[*selected_].goal.place;
  if (draft().name != before.name) kept_as_.clear();
  replaces_.clear();
  full_ = false;
  emit changed();
}

void RouteTool::select(std::optional<std::size_t> index) {
  selected_ = index && *index < draft().points.size() ? index : std::nullopt;
  if (selected_) cross_ = draft().points[*selected_].goal.place;
  emit changed();
}

// On a point: takes it. On a leg: a new point within the leg. Elsewhere: a new point at the end.
void RouteTool::press(Eigen::Vector2d at, double reach) {
  letGo();
  pressed_ = at;
  const auto hit = pointAt(draft(), at, reach);
  if (hit) {
    select(hit);
  } else if (!addPoint(legAt(draft(), at, 0.6 * reach).value_or(draft().points.size()), at)) {
    return;
  }
  turning_ = !hit;
  held_ = true;
}

/// @return whether there was room for one more.
bool RouteTool::addPoint(std::size_t before, Eigen::Vector2d at) {
  const RouteDraft after = withPoint(draft(), before, {{at, std::nullopt}, 0.0});
  full_ = after.points.size() == draft().points.size();
  if (full_) {
    emit changed();
    return false;
  }
  history_.step(after, tr("add a point"));
  select(before);
  return true;
}

/// The mouse has no point any more, though its button may be down.
void RouteTool::letGo() {
  held_ = turning_ = false;
  dragged_to_.reset();
}

void RouteTool::drag(Eigen::Vector2d at, double reach) {
  if (!selected_ || !held_) return;
  if (turning_) {
    if ((at - pressed_).norm() <= reach) return;
    const Eigen::Vector2d way = at - pressed_;
    history_.step(withHeading(draft(), *selected_, std::atan2(way.y(), way.x())),
                  tr("turn point %1").arg(*selected_ + 1), kTurns + static_cast<int>(*selected_));
    return;
  }
  if (!dragged_to_ && (at - pressed_).norm() < 0.3 * reach) return;
  dragged_to_ = at;
}

void RouteTool::release() {
  if (dragged_to_ && selected_) {
    history_.step(withPlace(draft(), *selected_, *dragged_to_),
                  tr("move point %1").arg(*selected_ + 1));
  }
  letGo();
}

RouteDraft RouteTool::shown() const {
  return dragged_to_ && selected_ ? withPlace(draft(), *selected_, *dragged_to_) : draft();
}

void RouteTool::nudge(Eigen::Vector2d by) {
  cross_ += by;
  if (!selected_) return;
  history_.step(withPlace(draft(), *selected_, cross_), tr("move point %1").arg(*selected_ + 1),
                kMoves + static_cast<int>(*selected_));
}

// After the selected point; without one at the end.
void RouteTool::insertAtCross() {
  addPoint(selected_ ? *selected_ + 1 : draft().points.size(), cross_);
}

void RouteTool::turn(double by) {
  if (!selected_) return;
  const double heading = draft().points[*selected_].goal.heading.value_or(0.0);
  history_.step(withHeading(draft(), *selected_, wrapped(heading + by)),
                tr("turn point %1").arg(*selected_ + 1), kTurns + static_cast<int>(*selected_));
}

void RouteTool::order(int by) {
  if (!selected_) return;
  const RouteDraft after = withOrder(draft(), *selected_, by);
  if (after == draft()) return;
  const std::size_t to = by < 0 ? *selected_ - 1 : *selected_ + 1;
  history_.step(after, tr("order of point %1").arg(*selected_ + 1));
  select(to);
}

void RouteTool::setPause(double seconds) {
  if (!selected_) return;
  history_.step(withPause(draft(), *selected_, seconds),
                tr("pause at point %1").arg(*selected_ + 1),
                kPauses + static_cast<int>(*selected_));
}

void RouteTool::setLoop(bool loop) {
  history_.step(withLoop(draft(), loop), loop ? tr("loop") : tr("no loop"));
}

void RouteTool::setName(const std::string& name) {
  history_.setName(name);
  replaces_.clear();
  emit changed();
}

// Over what it was loaded from it is saved at once; over another route only when told twice.
void RouteTool::save() {
  if (!ask_) return;
  if (draft().name == kept_as_ || draft().name == replaces_) {
    kept_as_ = draft().name;
    replaces_.clear();
    return ask_([&](PlaceAsks& asks) { asks.saveRoute(draft()); });
  }
  saving_ = Saving{draft().name, steadySeconds()};
  load({});  // what is there already
}

void RouteTool::listed(const std::vector<std::string>& files, double now) {
  const auto saving = std::exchange(saving_, std::nullopt);
  if (!saving || saving->name != draft().name || now - saving->since > kPatience) return;
  replaces_ = saving->name;
  if (std::count(files.begin(), files.end(), saving->name) == 0) save();
}

void RouteTool::load(const std::string& name) {
  if (ask_) ask_([&](PlaceAsks& asks) { asks.loadRoute(name); });
}

void RouteTool::send() {
  if (faultOf(draft()).empty() && ask_) ask_([&](PlaceAsks& asks) { asks.driveRoute(draft()); });
}

void RouteTool::key(ToolKey key) {
  letGo();
  const std::size_t count = draft().points.size();
  switch (key) {
    case ToolKey::kEnter:
      return send();
    case ToolKey::kTakeBack:
      return select(std::nullopt);
    case ToolKey::kTurnLeft:
      return turn(kTurn);
    case ToolKey::kTurnRight:
      return turn(-kTurn);
    case ToolKey::kAnyHeading:
      if (selected_) {
        history_.step(withHeading(draft(), *selected_, std::nullopt),
                      tr("any heading at point %1").arg(*selected_ + 1));
      }
      return;
    case ToolKey::kLess:
      return select(count == 0 ? 0 : selected_ ? (*selected_ + count - 1) % count : count - 1);
    case ToolKey::kMore:
      return select(count == 0 ? 0 : selected_ ? (*selected_ + 1) % count : 0);
    case ToolKey::kRemove:
      if (selected_) {
        const std::size_t index = *selected_;
        history_.step(withoutPoint(draft(), index), tr("remove point %1").arg(index + 1));
        if (!draft().empty()) select(std::min(index, draft().points.size() - 1));
      }
      return;
    case ToolKey::kInsert:
      return insertAtCross();
    case ToolKey::kEarlier:
      return order(-1);
    case ToolKey::kLater:
      return order(1);
    case ToolKey::kLoop:
      return setLoop(!draft().loop);
    case ToolKey::kUndo:
      return history_.stack().undo();
    case ToolKey::kRedo:
      return history_.stack().redo();
    case ToolKey::kSave:
      return save();
    case ToolKey::kLoad:
      emit loadWanted();
      return;
    case ToolKey::kNearest:
      return;
  }
}

std::optional<std::size_t> RouteTool::underWay() const {
  const auto navigation = state_.navigation.latest();
  const auto task = state_.task.latest();
  if (!navigation || !task || task->behaviour != "route") return std::nullopt;
  if (task->phase != TaskPhase::kRunning && task->phase != TaskPhase::kPaused) return std::nullopt;
  const std::size_t index = navigation->point;
  if (navigation->points != draft().points.size() || index >= draft().points.size()) {
    return std::nullopt;
  }
  const bool same = (draft().points[index].goal.place - navigation->goal).norm() < kSamePlace;
  return same ? std::optional(index) : std::nullopt;
}

/// Asks for the way of a leg where one is due. @return a way has come.
bool RouteTool::refreshWays(double now) {
  ways_.follow(draft(), now);
  if (const auto leg = ask_ ? ways_.due(now) : std::nullopt) {
    ask_([&](PlaceAsks& asks) { asks.preview(leg->id, leg->to, leg->from); });
  }
  auto newest = state_.preview.get();
  if (newest == heard_) return false;
  heard_ = std::move(newest);
  return ways_.answered(heard_);
}

bool RouteTool::refresh(double now) {
  const auto shelf = state_.shelf.get();
  if (shelf && shelf->serial != shelf_) {
    shelf_ = shelf->serial;
    if (shelf->route) {
      letGo();
      history_.step(*shelf->route, tr("load %1").arg(QString::fromStdString(shelf->route->name)));
      kept_as_ = shelf->route->name;
      selected_.reset();
    } else {
      listed(shelf->files, now);
    }
    emit changed();
  }
  const bool news = in_hand_ && refreshWays(now);
  const auto index = underWay();
  if (index == under_way_) return news;
  under_way_ = index;
  emit changed();
  return true;
}

AimWords RouteTool::words() {
  if (draft().empty()) {
    return {Severity::kNote, "Route: click for a point, drag for its heading",
            "or move the cross with the arrow keys, Insert puts a point there; Ctrl+O loads"};
  }
  AimWords words;
  const std::string fault = faultOf(draft());
  const std::size_t count = draft().points.size();
  words.severity = fault.empty() ? Severity::kGood : Severity::kWarning;
  words.headline = std::to_string(count) + (count == 1 ? " point, " : " points, ");
  const RoutePreview::Sum ways = ways_.sum();
  if (ways.complete) {
    words.headline += lengthWords(ways.length) + ", about " + timeWords(ways.time);
  } else {
    words.headline += lengthWords(draft().length()) + " straight";
  }
  if (draft().loop) words.headline += ", over and over";
  if (ways.blocked) {
    words.severity = Severity::kWarning;
    const std::size_t to = *ways.blocked;
    words.headline += ". No way" + (to > 0 ? " from point " + std::to_string(to) : std::string()) +
                      " to point " + std::to_string(to % count + 1);
  }
  if (!fault.empty()) words.headline = fault;
  words.advice = ways.blocked ? ways_.legTo(*ways.blocked)->why + "; Enter sends it all the same"
                 : selected_
                     ? "Arrows or a drag move it, , . turn it, Delete removes it; Enter sends"
                     : "[ and ] choose a point, a click on a leg inserts one; Enter sends";
  if (full_) {
    words.severity = Severity::kWarning;
    words.headline = "1,000 points are the most that a route has";
  }
  if (!replaces_.empty()) {
    words.severity = Severity::kWarning;
    words.headline = "The robot has a route " + replaces_ + " already";
    words.advice = "Ctrl+S again replaces it; another name keeps both";
  }
  return words;
}

void RouteTool::begin(Eigen::Vector2d at) {
  if (!selected_) cross_ = at;
  in_hand_ = true;
}

void RouteTool::end() {
  letGo();
  replaces_.clear();
  in_hand_ = false;
}

}  // namespace pilothouse::gui
