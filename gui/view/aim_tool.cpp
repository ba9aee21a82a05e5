#include "gui/view/aim_tool.hpp"

#include <algorithm>
#include <utility>

#include "gui/model/clock.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/place_layers.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {
constexpr double kTurn = 15.0 / 57.29577951308232;  // rad a key
constexpr double kSpreadStep = 1.5;
}  // namespace

AimTool::AimTool(For what, const PlaceState& state, AskPlace ask, Footprint outline)
    : for_(what),
      state_(state),
      ask_(std::move(ask)),
      outline_(std::move(outline)),
      aim_(what == For::kGoal) {}

// A press on the ghost sends it when let go there; a press elsewhere puts it there.
void AimTool::press(Eigen::Vector2d at, double reach) {
  const auto& goal = aim_.goal();
  sends_on_release_ = goal && (goal->place - at).norm() <= reach;
  if (sends_on_release_) return;
  cross_ = at;
  aim_.place(at);
  if (for_ == For::kPose && !aim_.goal()->heading) aim_.setHeading(0.0);
}

void AimTool::drag(Eigen::Vector2d at, double reach) {
  if (!aim_.goal() || (at - aim_.goal()->place).norm() <= reach) return;
  sends_on_release_ = false;
  aim_.face(at);
}

void AimTool::release() {
  if (std::exchange(sends_on_release_, false)) enter();
}

void AimTool::nudge(Eigen::Vector2d by) {
  cross_ += by;
  if (aim_.goal()) aim_.place(cross_);
}

void AimTool::enter() {
  if (!aim_.goal()) {
    aim_.place(cross_);
    if (for_ == For::kPose) aim_.setHeading(0.0);
    return;
  }
  now_ = steadySeconds();
  if (aim_.version() == seen_ && now_ - seen_since_ >= kLook) send();
}

void AimTool::send() {
  const auto goal = aim_.send(now_);
  if (!goal || !ask_) return;
  if (for_ == For::kGoal) return ask_([&](PlaceAsks& asks) { asks.goTo(*goal); });
  const Pose2 pose{goal->place.x(), goal->place.y(), goal->heading.value_or(0.0)};
  ask_([&](PlaceAsks& asks) { asks.setPose(pose, spread_); });
}

void AimTool::spreadBy(double factor) {
  spread_.place = std::clamp(spread_.place * factor, 0.02, 5.0);
  spread_.heading = std::clamp(spread_.heading * factor, 0.01, 3.14);
}

void AimTool::key(ToolKey key) {
  switch (key) {
    case ToolKey::kEnter:
      return enter();
    case ToolKey::kTakeBack:
      return aim_.takeBack();
    case ToolKey::kTurnLeft:
      return aim_.turn(kTurn);
    case ToolKey::kTurnRight:
      return aim_.turn(-kTurn);
    case ToolKey::kAnyHeading:
      if (for_ == For::kGoal) aim_.setHeading(std::nullopt);
      return;
    case ToolKey::kNearest:
      if (aim_.takeNearest()) cross_ = aim_.goal()->place;
      return;
    case ToolKey::kLess:
      return spreadBy(1.0 / kSpreadStep);
    case ToolKey::kMore:
      return spreadBy(kSpreadStep);
    default:
      return;
  }
}

void AimTool::paint(QPainter& painter, const MapView& view) {
  const auto& goal = aim_.goal();
  if (!goal) return paintCross(painter, view, cross_);
  const AimPhase phase = aim_.phase(now_);
  QColor colour = ghostColour();
  if (phase == AimPhase::kNoWay) colour = theme::kError;
  if (for_ == For::kPose) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    covariance(0, 0) = covariance(1, 1) = spread_.place * spread_.place;
    covariance(2, 2) = spread_.heading * spread_.heading;
    paintSpread(painter, view, {goal->place.x(), goal->place.y(), goal->heading.value_or(0.0)},
                covariance, colour);
  } else if (const Preview* preview = aim_.preview()) {
    if (preview->found) paintPath(painter, view, preview->path.points, colour, true);
    if (phase == AimPhase::kNoWay && preview->nearest) {
      paintNearest(painter, view, goal->place, *preview->nearest);
    }
  }
  paintGhost(painter, view, outline_, goal->place, goal->heading, colour);
  if (for_ != For::kGoal || phase != AimPhase::kFound) return;
  const QPointF beside = view.toPixel(goal->place.x(), goal->place.y()) + QPointF(18, 18);
  paintPill(painter, beside, Qt::AlignLeft | Qt::AlignTop,
            QString::fromStdString(wayWords(*aim_.preview())), colour);
}

AimWords AimTool::words() {
  return for_ == For::kGoal ? goalWords(aim_, now_) : poseWords(aim_, spread_);
}

bool AimTool::refresh(double now) {
  now_ = now;
  std::uint32_t id = 0;
  const auto goal = aim_.due(now, id);
  if (goal && ask_) ask_([&](PlaceAsks& asks) { asks.preview(id, *goal, {}); });
  auto newest = state_.preview.get();
  const bool news = newest != heard_;
  if (news) aim_.answered(heard_ = std::move(newest));
  const AimPhase phase = aim_.phase(now);
  const bool can_be_sent = phase == AimPhase::kFound || phase == AimPhase::kUnanswered;
  if (!can_be_sent || phase != shown_ || aim_.version() != seen_) seen_since_ = now;
  seen_ = aim_.version();
  return std::exchange(shown_, phase) != phase || news;
}

void AimTool::begin(Eigen::Vector2d at) {
  cross_ = at;
}

void AimTool::end() {
  aim_.takeBack();
  sends_on_release_ = false;
}

}  // namespace pilothouse::gui
