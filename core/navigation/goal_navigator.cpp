#include "core/navigation/goal_navigator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kLost = 10.0;        // without a pose for so long it gives up [s]
constexpr double kNoMap = 3.0;        // without a map that reaches it likewise [s]
constexpr double kHeardAfter = 0.15;  // reports so soon after an order may be of the one before [s]
constexpr double kGotOn = 0.05;       // nearer by so much is getting on [m]
constexpr double kTurned = 0.15;      // and so is turning by so much [rad] ...
constexpr double kLongestTurn = 12.0;  // ... for so long [s]
constexpr double kLongestLook = 12.0;  // the executor is let look for so long [s]
constexpr double kSamePlace = 0.8;     // held so near to where it looked it is the same case [m]
constexpr double kHeldAtGoal = 0.25;   // within its tolerance that is as near as it gets [s]
constexpr double kTrailStep = 0.05;    // [m]
constexpr std::size_t kTrail = 100;
constexpr double kSpeedTime = 10.0;  // the speed is averaged over this [s]
constexpr double kSlowest = 0.05;    // that a time is foretold with [m/s]
constexpr int kArrivals = 5;

const NavigationParameters& checked(const NavigationParameters& parameters) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "\n") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
  return parameters;
}

}  // namespace

GoalNavigator::GoalNavigator(const NavigationParameters& parameters, Planner& planner)
    : parameters_(checked(parameters)), planner_(planner), speed_(parameters.cruise) {}

void GoalNavigator::start(const Goal& goal, std::vector<Goal> beyond) {
  goal_ = goal;
  beyond_ = std::move(beyond);
  plans_ = 0;
  speed_ = parameters_.cruise;
  planner_.ignoreHidden(false);
  resume();
}

void GoalNavigator::cancel() {
  phase_ = NavigationPhase::kIdle;
  path_.clear();
  text_.clear();
}

void GoalNavigator::resume() {
  phase_ = NavigationPhase::kPlanning;
  begins_ = true;
  path_.clear();
  text_.clear();
  trail_.clear();
  forget();
}

/// What it tried so far.
void GoalNavigator::forget() {
  nearest_.reset();
  tries_ = arrivals_ = 0;
  measure_ = Measure::kReplan;
  stuck_off_ = HUGE_VAL;
  settling_ = false;
  looked_from_.clear();
  avoided_.clear();
  looked_at_.reset();
  executor_looks_ = false;
}

void GoalNavigator::enter(NavigationPhase phase) {
  phase_ = phase;
  since_ = now_;
}

bool GoalNavigator::isHeard(const NavigationInput& input, ExecutorReport::State state) const {
  return input.executor.state == state && input.executor.stamp > sent_ + kHeardAfter;
}

void GoalNavigator::send(std::vector<Pose2> poses, std::optional<double> heading) {
  ordered_ = !poses.empty();
  order_ = DriveOrder{std::move(poses), heading};
  sent_ = now_;
}

/// Whatever it was ordered to drive, of this goal or of one before, is driven no more.
void GoalNavigator::halt() {
  if (ordered_) send({}, std::nullopt);
  path_.clear();
}

void GoalNavigator::fail(const std::string& text, const std::optional<Vector2d>& nearest) {
  halt();
  text_ = text;
  nearest_ = nearest;
  enter(NavigationPhase::kFailed);
}

double GoalNavigator::left() const {
  return path_.empty() ? 0.0 : std::max(0.0, ends_.front() - way_);
}

void GoalNavigator::planFirst(const NavigationInput& input) {
  const MapCells& map = planner_.map();
  const double column = (input.pose->x - map.origin_x) / map.cell_size;
  const double row = (input.pose->y - map.origin_y) / map.cell_size;
  const bool inside = column >= 0.0 && column < map.size_x && row >= 0.0 && row < map.size_y;
  if (planner_.hasMap() && inside) {
    got_on_ = turned_on_ = now_;
    replan(input);
    return;
  }
  halt();
  text_ = textOf(planner_.hasMap() ? NoWay::kStartOutside : NoWay::kNoMap);
  if (now_ - since_ > kNoMap) fail(text_, std::nullopt);
}

/// Where it is on its path, where it came along, and how fast.
void GoalNavigator::follow(const NavigationInput& input, double dt) {
  const Pose2& pose = *input.pose;
  if (trail_.empty() || (pose.position() - trail_.back().position()).norm() > kTrailStep) {
    trail_.push_back(pose);
    if (trail_.size() > kTrail) trail_.pop_front();
  }
  if (!path_.empty()) {
    const double before = way_;
    const Route::Foot foot = route_.nearest(pose.position(), std::max(0.0, way_ - 0.5), way_ + 1.0);
    way_ = foot.way;
    off_way_ = foot.distance;
    if (!input.halted && dt > 0.0) {
      const double share = std::min(1.0, dt / kSpeedTime);
      speed_ += share * (std::max(0.0, way_ - before) / dt - speed_);
    }
    if (left() < best_left_ - kGotOn) {
      best_left_ = left();
      got_on_ = now_;
    }
  }
  if (std::abs(wrapped(pose.heading - turned_to_)) > kTurned) {
    turned_to_ = pose.heading;
    turned_on_ = now_;
  }
}

void GoalNavigator::drive(const NavigationInput& input) {
  if (!path_.empty() && off_way_ > kOffWay && !settling_) {
    // Its pose was set or corrected: whatever lies between here and the way was not looked at.
    trail_.clear();
    replan(input);
    return;
  }
  // On a way through what is seen far off more of that comes near, whether or not it changes.
  if ((revision_ != planner_.revision() || nearing_) && !settling_) {
    revision_ = planner_.revision();
    const bool blocked = path_.empty() || !planner_.free(judged(*input.pose));
    if (blocked && (!path_.empty() || now_ - sought_ > kTryAgain)) {
      replan(input);
      return;
    }
    if (!blocked && now_ - sought_ > kTryAgain && !planner_.roomy(judged(*input.pose))) {
      seekRoomier(input);
    }
  }
  if (path_.empty() && now_ - sought_ > kTryAgain && replan(input)) return;
  lengthenInTime(input);
  if (ended()) return;
  if (!path_.empty()) hear(input);
  if (phase_ != NavigationPhase::kDriving && phase_ != NavigationPhase::kWaiting) return;
  if (input.halted) got_on_ = turned_on_ = now_;
  const double on = std::max(got_on_, std::min(turned_on_, got_on_ + kLongestTurn));
  if (now_ - on > parameters_.patience) {
    stuck(input);
  } else if (phase_ == NavigationPhase::kDriving && !settling_ &&
             now_ - sought_ > parameters_.replan_period) {
    seekShorter(input);
  }
}

/// What the executor says of the way that it was given.
void GoalNavigator::hear(const NavigationInput& input) {
  if (isHeard(input, ExecutorReport::kReached)) return arrive(input);
  const bool idle = isHeard(input, ExecutorReport::kIdle);
  if (idle || isHeard(input, ExecutorReport::kRefused)) {
    // It was started afresh, or had no pose: once more, at the pace of new plans.
    text_ = idle ? "the executor forgot its route" : "the executor refused: " + input.executor.text;
    if (now_ - sent_ > parameters_.replan_period) send(rest(*input.pose), endHeading());
    return;
  }
  const bool waits = isHeard(input, ExecutorReport::kWaiting);
  if (!waits && !isHeard(input, ExecutorReport::kDriving)) return;
  const NavigationPhase phase = waits ? NavigationPhase::kWaiting : NavigationPhase::kDriving;
  if (phase != phase_) enter(phase);
  text_ = input.executor.text;
  letLook(input, !waits && !text_.empty());
  if (waits && now_ - since_ > kHeldAtGoal) settle(input);
}

/// Going back to look at what holds the robot is the executor's part, which alone knows what that
/// is: meanwhile nobody is stuck. Once in a place: held there again, the next measure comes.
void GoalNavigator::letLook(const NavigationInput& input, bool looks) {
  if (looks && !executor_looks_) {
    looking_since_ = hasLooked(input) ? -HUGE_VAL : now_;
    looked_at_ = input.pose->position();
  }
  const bool first = now_ - looking_since_ < kLongestLook;
  if (looks) {
    turned_on_ = got_on_;  // turning to look is not getting on
    if (first) got_on_ = turned_on_ = now_;
  } else if (executor_looks_ && first) {
    best_left_ = left();  // on from where it went back to
  }
  executor_looks_ = looks;
}

/// Whether the executor has looked at what holds the robot here.
bool GoalNavigator::hasLooked(const NavigationInput& input) const {
  return looked_at_ && (*looked_at_ - input.pose->position()).norm() < kSamePlace;
}

/// Held within the tolerance of the goal it is there: nearer it would not be let, and the executor,
/// whose tolerance is its own, would go back to look. Only the heading is left to do.
void GoalNavigator::settle(const NavigationInput& input) {
  const double off = (input.pose->position() - goal_.place).norm();
  if (settling_ || ends_.size() > 1 || off > parameters_.position_tolerance) return;
  settling_ = true;
  send({*input.pose}, goal_.heading);
}

void GoalNavigator::arrive(const NavigationInput& input) {
  const double off = (input.pose->position() - goal_.place).norm();
  const double turn = goal_.heading ? std::abs(wrapped(*goal_.heading - input.pose->heading)) : 0.0;
  if (off <= parameters_.position_tolerance && turn <= parameters_.heading_tolerance) {
    path_.clear();
    text_.clear();
    enter(NavigationPhase::kReached);
    return;
  }
  char text[96];
  std::snprintf(text, sizeof text,
                "stands %.2f m and %.0f degrees off the goal and comes no nearer", off,
                turn * 180.0 / 3.14159265358979);
  if (++arrivals_ > kArrivals) return fail(text, std::nullopt);
  replan(input);
}

NavigationOutput GoalNavigator::step(const NavigationInput& input) {
  order_.reset();
  const double dt = input.now - now_;
  // Time was set back, or this is the first step: what is measured begins now.
  if (begins_ || dt < 0.0) {
    since_ = sent_ = sought_ = got_on_ = turned_on_ = lengthened_ = placed_ = looking_since_ =
        input.now;
    begins_ = false;
  }
  now_ = input.now;
  if (input.pose && input.pose->finite()) {
    placed_ = now_;
    follow(input, std::max(0.0, dt));
    if (phase_ == NavigationPhase::kPlanning)
      planFirst(input);
    else if (phase_ == NavigationPhase::kDriving || phase_ == NavigationPhase::kWaiting)
      drive(input);
    else if (!ended())
      manoeuvre(input);
  } else if (!ended()) {
    text_ = "the robot's place in the map is not known";
    if (now_ - placed_ > kLost) fail(text_, std::nullopt);
  }
  NavigationOutput output;
  output.status = status();
  output.order = order_;
  return output;
}

NavigationStatus GoalNavigator::status() const {
  NavigationStatus status;
  status.phase = phase_;
  status.text = text_;
  status.goal = goal_;
  status.path = path_;
  status.plans = plans_;
  if (phase_ == NavigationPhase::kFailed) status.nearest = nearest_;
  if (phase_ == NavigationPhase::kReached) status.distance_left = status.time_left = 0.0;
  if (path_.empty() || phase_ == NavigationPhase::kBacking) return status;
  status.distance_left = left();
  status.time_left = left() / std::max(kSlowest, speed_);
  return status;
}

}  // namespace pilothouse
