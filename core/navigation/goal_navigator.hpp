#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/navigation/navigation_parameters.hpp"
#include "core/planning/planner.hpp"

namespace pilothouse {

struct Goal {
  Eigen::Vector2d place{0.0, 0.0};  ///< map frame [m]
  std::optional<double> heading;    ///< none: any [rad]
};

/// What the motion executor is to drive, map frame; no points: to stop.
struct DriveOrder {
  std::vector<Pose2> poses;
  std::optional<double> heading;  ///< at the end; none: as it comes [rad]
};

/// What the motion executor said last.
struct ExecutorReport {
  enum State { kNone, kIdle, kDriving, kWaiting, kReached, kRefused };
  State state = kNone;
  double stamp = 0.0;  ///< when it said so [s]
  std::string text;    ///< driving: it goes back to look at what holds it; none: it drives its way
};

struct NavigationInput {
  double now = 0.0;           ///< [s]
  std::optional<Pose2> pose;  ///< of the base, map frame; none: not known now
  ExecutorReport executor;
  bool halted =
      false;  ///< the stop gate lets nothing pass: nobody gets on, and that is nobody's fault
};

/// As in the message NavigationState.
enum class NavigationPhase {
  kIdle = 0,
  kPlanning = 1,
  kDriving = 2,
  kWaiting = 3,
  kLooking = 4,
  kBacking = 5,
  kPausing = 6,
  kReached = 7,
  kFailed = 8,
};

struct NavigationStatus {
  NavigationPhase phase = NavigationPhase::kIdle;
  std::string text;
  Goal goal;
  std::vector<Pose2> path;  ///< that is driven, map frame
  unsigned plans = 0;
  std::optional<double> distance_left, time_left;  ///< [m], [s]
  std::optional<Eigen::Vector2d> nearest;  ///< failed: the nearest place that can be reached
};

struct NavigationOutput {
  NavigationStatus status;
  std::optional<DriveOrder> order;  ///< new in this step
};

/// Drives to one goal: plans, has the executor drive, plans anew when the way is blocked or a much
/// shorter one appears. Stuck, it waits, looks round, backs off and plans again, and after some
/// tries gives up with the reason. A pure function of what it is told, times included.
class GoalNavigator {
 public:
  /// @param planner outlives this. @throws std::invalid_argument listing every fault.
  GoalNavigator(const NavigationParameters& parameters, Planner& planner);

  /// @param beyond goals that it is to drive on to without standing at those before; what has been
  ///   planned of that is one way with the one to `goal`.
  void start(const Goal& goal, std::vector<Goal> beyond = {});
  /// The goal counts as reached: on to the next, which was the first beyond, on the way under way
  /// where that leads there. @param beyond that one.
  void goOn(const Goal& next, std::vector<Goal> beyond);
  /// Whether the way under way leads on beyond the goal, and the robot has come past it on it.
  bool isPast() const { return ends_.size() > 1 && way_ >= ends_.front(); }
  void cancel();
  /// What it knows of getting stuck is forgotten and the way planned anew: after a pause.
  void resume();
  NavigationOutput step(const NavigationInput& input);
  const Planner& planner() const { return planner_; }
  bool ended() const {
    return phase_ == NavigationPhase::kReached || phase_ == NavigationPhase::kFailed ||
           phase_ == NavigationPhase::kIdle;
  }

 private:
  static constexpr double kOffWay = 0.3;    ///< farther beside its way it is elsewhere [m]
  static constexpr double kTryAgain = 0.5;  // while there is no way one is sought so often [s]

  enum class Measure { kReplan, kLook, kBack, kRest };
  /// A way, and whether it leads through what is seen far off.
  struct Found {
    Plan plan;
    bool nearing = false;
  };
  Found seek(const NavigationInput& input);
  void planFirst(const NavigationInput& input);
  void follow(const NavigationInput& input, double dt);
  void drive(const NavigationInput& input);
  void hear(const NavigationInput& input);
  void letLook(const NavigationInput& input, bool looks);
  bool hasLooked(const NavigationInput& input) const;
  void settle(const NavigationInput& input);
  void arrive(const NavigationInput& input);
  bool replan(const NavigationInput& input);
  void seekShorter(const NavigationInput& input);
  void seekRoomier(const NavigationInput& input);
  void stuck(const NavigationInput& input);
  bool isFree(const NavigationInput& input);
  void lookRound(const NavigationInput& input);
  void lookTo(int look);
  void avoidHere();
  bool backOff(const NavigationInput& input);
  bool lookAtBlock(const NavigationInput& input);
  bool goPastHidden(const NavigationInput& input);
  std::optional<Eigen::Vector2d> blockOf(const NavigationInput& input);
  bool drivesToLook(const NavigationInput& input, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& block);
  void manoeuvre(const NavigationInput& input);
  void fail(const std::string& text, const std::optional<Eigen::Vector2d>& nearest);
  void send(std::vector<Pose2> poses, std::optional<double> heading);
  void halt();
  void lay(std::vector<Pose2> poses);
  void take(Found found);
  void forget();
  bool lengthen();
  void lengthenInTime(const NavigationInput& input);
  void change(Found found);
  void enter(NavigationPhase phase);
  bool isHeard(const NavigationInput& input, ExecutorReport::State state) const;
  double left() const;
  std::optional<double> endHeading() const;
  std::vector<Pose2> rest(const Pose2& pose) const;
  std::vector<Pose2> judged(const Pose2& pose) const;
  PlanRequest request(const NavigationInput& input) const;
  NavigationStatus status() const;

  NavigationParameters parameters_;
  Planner& planner_;
  NavigationPhase phase_ = NavigationPhase::kIdle;
  Goal goal_;
  std::vector<Goal> beyond_;
  std::string text_;
  std::vector<Pose2> path_;  ///< none: there is no way now, or it manoeuvres
  Route route_;              ///< the path as it is driven
  double way_ = 0.0;         ///< along it [m]
  double off_way_ = 0.0;     ///< beside it [m]
  std::deque<double> ends_;  ///< ways at which it comes to the goal and to those beyond [m]
  bool nearing_ = false;     ///< it leads through what is seen far off
  bool settling_ = false;    ///< it is near enough and only turns
  std::optional<Eigen::Vector2d> nearest_;
  std::optional<DriveOrder> order_;
  unsigned plans_ = 0;
  bool begins_ = false;
  bool ordered_ = false;  ///< the executor has something to drive
  // Times [s]: of this step, when the phase began, of the last order, of the last plan, of the last
  // pose, when it last got on and turned, and of the last try to lengthen its way.
  double now_ = 0.0, since_ = 0.0, sent_ = 0.0, sought_ = 0.0, placed_ = 0.0;
  double got_on_ = 0.0, turned_on_ = 0.0, lengthened_ = 0.0;
  double longest_ = 0.0;    ///< that it manoeuvres [s]
  double best_left_ = 0.0;  ///< [m]
  double turned_to_ = 0.0;  ///< [rad]
  std::uint32_t revision_ = 0;
  int tries_ = 0, arrivals_ = 0, looks_ = 0;
  Measure measure_ = Measure::kReplan;
  double stuck_off_ = 0.0;  ///< from the goal when it first was stuck [m]
  std::string stuck_by_;
  bool executor_looks_ = false;               ///< at what holds it
  std::optional<Eigen::Vector2d> looked_at_;  ///< where it stood when it began to
  double looking_since_ = 0.0;                ///< [s]
  Pose2 look_from_;
  std::deque<Pose2> trail_;
  std::vector<Planner::Mark> avoided_;        ///< where it was held though the way is free
  std::vector<Eigen::Vector2d> looked_from_;  ///< at what was in the way, in this case
  double speed_;                              ///< made so far, slowly averaged [m/s]
};

}  // namespace pilothouse
