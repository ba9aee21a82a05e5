#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "gui/model/place_asks.hpp"
#include "gui/model/situation.hpp"

namespace pilothouse::gui {

/// How far the preview of a goal has come.
enum class AimPhase {
  kNone,        ///< nothing is aimed at
  kAsking,      ///< the way to it is being planned
  kFound,       ///< there is a way
  kNoWay,       ///< there is none; why and perhaps the nearest place are told
  kUnanswered,  ///< nobody plans: it can be sent all the same
};

/// A goal before it is sent: a place, a heading or none, and the preview of the way there. Each
/// change asks anew, a few times a second at most; an answer to an older ask counts no more. No
/// time, no ROS of its own: steady seconds are arguments.
class GoalAim {
 public:
  static constexpr double kAskEvery = 0.15;  ///< [s]
  static constexpr double kPatience = 3.0;   ///< without an answer it counts as unanswered [s]

  /// @param asks false: a pose, which needs no way there.
  explicit GoalAim(bool asks = true) : asks_(asks) {}

  /// The place, with the heading it has.
  void place(Eigen::Vector2d at);
  /// The heading towards a point that is not the place itself.
  void face(Eigen::Vector2d point);
  void turn(double by);
  void setHeading(std::optional<double> heading);
  /// Nothing is aimed at any more.
  void takeBack();
  /// The nearest place that can be reached, in its stead; with any heading where it is the place
  /// itself: then the heading does not fit. @return false: none is known.
  bool takeNearest();

  const std::optional<PlaceGoal>& goal() const { return goal_; }
  /// Of the goal: each change counts.
  std::uint32_t version() const { return version_; }
  AimPhase phase(double now) const;
  /// The answer to the goal as it is; null: none yet.
  const Preview* preview() const { return answer_.get(); }

  /// What to ask now; none: nothing is due. @param id to be handed back with the answer.
  std::optional<PlaceGoal> due(double now, std::uint32_t& id);
  /// The newest answer, which may be old.
  void answered(std::shared_ptr<const Preview> preview);

  /// The goal, which is then no longer aimed at; none: it cannot be sent as it is.
  std::optional<PlaceGoal> send(double now);

 private:
  void changed();

  bool asks_;
  std::optional<PlaceGoal> goal_;
  std::uint32_t version_ = 0;  ///< of the goal
  std::uint32_t asked_ = 0;    ///< version of the newest ask
  double asked_at_ = -1e9;
  std::shared_ptr<const Preview> answer_;
};

/// A sentence and what to do.
struct AimWords {
  Severity severity = Severity::kNote;
  std::string headline, advice;
};

AimWords goalWords(const GoalAim& aim, double now);
AimWords poseWords(const GoalAim& aim, const PoseSpread& spread);

/// "12.4 m, about 35 s".
std::string wayWords(const Preview& preview);
/// "12.4 m", "85 cm"; "?" for NaN.
std::string lengthWords(double metres);
/// "35 s", "2 min 5 s", "1 h 2 min"; "?" for NaN.
std::string timeWords(double seconds);

}  // namespace pilothouse::gui
