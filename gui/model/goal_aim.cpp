#include "gui/model/goal_aim.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

namespace pilothouse::gui {

namespace {

constexpr double kFits = 0.05;  // m; a nearest place so near is the goal
constexpr double kSame = 1e-3;  // m; a point so near gives no heading

std::string formatted(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

void GoalAim::changed() {
  ++version_;
  answer_.reset();
}

void GoalAim::place(Eigen::Vector2d at) {
  if (!at.allFinite() || (goal_ && goal_->place == at)) return;
  if (!goal_) goal_.emplace();
  goal_->place = at;
  changed();
}

void GoalAim::face(Eigen::Vector2d point) {
  if (!goal_ || !point.allFinite()) return;
  const Eigen::Vector2d way = point - goal_->place;
  if (way.norm() < kSame) return;
  setHeading(std::atan2(way.y(), way.x()));
}

void GoalAim::turn(double by) {
  if (goal_ && std::isfinite(by)) setHeading(wrapped(goal_->heading.value_or(0.0) + by));
}

void GoalAim::setHeading(std::optional<double> heading) {
  if (!goal_ || (heading && !std::isfinite(*heading)) || goal_->heading == heading) return;
  goal_->heading = heading;
  changed();
}

void GoalAim::takeBack() {
  goal_.reset();
  changed();
}

bool GoalAim::takeNearest() {
  if (!goal_ || !answer_ || answer_->found || !answer_->nearest) return false;
  // The place itself: what does not fit there is the heading.
  if ((goal_->place - *answer_->nearest).norm() < kFits) goal_->heading.reset();
  goal_->place = *answer_->nearest;
  changed();
  return true;
}

AimPhase GoalAim::phase(double now) const {
  if (!goal_) return AimPhase::kNone;
  if (!asks_) return AimPhase::kFound;
  if (answer_ && !answer_->answered) return AimPhase::kUnanswered;
  if (answer_) return answer_->found ? AimPhase::kFound : AimPhase::kNoWay;
  const bool waited = asked_ == version_ && now - asked_at_ > kPatience;
  return waited ? AimPhase::kUnanswered : AimPhase::kAsking;
}

std::optional<PlaceGoal> GoalAim::due(double now, std::uint32_t& id) {
  if (!asks_ || !goal_ || asked_ == version_ || now - asked_at_ < kAskEvery) return std::nullopt;
  asked_ = id = version_;
  asked_at_ = now;
  return goal_;
}

void GoalAim::answered(std::shared_ptr<const Preview> preview) {
  if (goal_ && preview && preview->id == version_) answer_ = std::move(preview);
}

std::optional<PlaceGoal> GoalAim::send(double now) {
  const AimPhase now_in = phase(now);
  if (now_in != AimPhase::kFound && now_in != AimPhase::kUnanswered) return std::nullopt;
  const auto sent = goal_;
  takeBack();
  return sent;
}

std::string lengthWords(double metres) {
  if (!std::isfinite(metres)) return "?";
  if (metres < 0.995) return formatted("%.0f cm", metres * 100.0);
  return formatted(metres < 99.95 ? "%.1f m" : "%.0f m", metres);
}

std::string timeWords(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  const long whole = std::lround(seconds);
  const long minutes = whole / 60, hours = minutes / 60;
  if (whole < 60) return std::to_string(whole) + " s";
  if (hours < 1) {
    const long rest = whole % 60;
    return std::to_string(minutes) + " min" + (rest ? " " + std::to_string(rest) + " s" : "");
  }
  return std::to_string(hours) + " h " + std::to_string(minutes % 60) + " min";
}

std::string wayWords(const Preview& preview) {
  return lengthWords(preview.path.length) + ", about " + timeWords(preview.time);
}

AimWords goalWords(const GoalAim& aim, double now) {
  const Preview* preview = aim.preview();
  switch (aim.phase(now)) {
    case AimPhase::kNone:
      return {Severity::kNote, "Goal: press at the place, drag for the heading",
              "or move the cross with the arrow keys; Enter puts the goal there"};
    case AimPhase::kAsking:
      return {Severity::kNote, "Planning the way ...", "Backspace takes the goal back"};
    case AimPhase::kFound:
      return {Severity::kGood, wayWords(*preview),
              "Enter or a click on it sends the robot; Backspace takes it back"};
    case AimPhase::kNoWay:
      return {Severity::kError, "No way there" + (preview->why.empty() ? "" : ": " + preview->why),
              preview->nearest ? "T takes the nearest place that can be reached, marked by a ring"
                               : "Try another place; Backspace takes it back"};
    case AimPhase::kUnanswered:
      break;
  }
  return {Severity::kWarning,
          "No preview" + (preview && !preview->why.empty() ? ": " + preview->why
                                                           : ": the planner does not answer"),
          "Enter sends the goal all the same; Backspace takes it back"};
}

AimWords poseWords(const GoalAim& aim, const PoseSpread& spread) {
  if (!aim.goal()) {
    return {Severity::kNote, "Pose: press where the robot is, drag for its heading",
            "or move the cross with the arrow keys; Enter puts the robot there"};
  }
  const std::string sure =
      formatted("within %.2f m and ", spread.place) +
      formatted("%.0f degrees", spread.heading * 180.0 / 3.14159265358979323846);
  return {Severity::kWarning, "The robot is here, " + sure,
          "[ and ] tell how sure; Enter or a click on it sets the pose; Backspace takes it back"};
}

}  // namespace pilothouse::gui
