#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/motion/footprint.hpp"
#include "core/motion/obstacle.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse {

/// The corridor of the original (KTU 2014, step 7): the distance of a point p from the line through
/// the base's origin a along the motion n is |(a - p) - ((a - p) . n) n|; the corridor is as wide
/// as the footprint's corner that is farthest from the line. Ahead is positive along n.
class Corridor {
 public:
  /// @param direction of the motion in the base frame; normalised here, not zero.
  Corridor(const Footprint& footprint, const Eigen::Vector2d& direction, double margin);
  double halfWidth() const { return half_width_; }
  /// In the way within the corridor and ahead; potential within the margin beside it.
  Relevance classify(const Eigen::Vector2d& point, double radius) const;

 private:
  Eigen::Vector2d direction_;
  double half_width_;
  double margin_;
};

/// Where the footprint goes when the base holds a twist: straight, along an arc, or turning in
/// place.
class SweptPath {
 public:
  /// @param twist only its shape matters; zero: nothing is ever touched.
  /// @param margin beside the swept area that makes a potential obstacle [m].
  /// @param look_ahead the path is followed so far [m], and an arc for 1.2 rad at most: farther on
  ///   nobody means to hold it.
  SweptPath(const Footprint& footprint, const Twist2& twist, double margin, double look_ahead);

  struct Contact {
    Relevance relevance = Relevance::kOther;
    /// Way that the touching point of the robot goes until it touches [m]; for a potential
    /// obstacle, until it comes beside; infinite for others.
    double distance = std::numeric_limits<double>::infinity();
    double speed = 0.0;  ///< of that point for a path speed of 1
  };
  /// @param radius of the object [m].
  Contact meet(const Eigen::Vector2d& point, double radius) const;

  /// Path speed: of the fastest point of the footprint [m/s].
  static double speedOf(const Footprint& footprint, const Twist2& twist);
  /// The base's pose after that way of its fastest point [m], from where it is now.
  Pose2 poseAfter(double way) const;

 private:
  static constexpr double kNever = -1.0;
  static constexpr double kInside = -2.0;
  struct TurningEdge {
    double offset;  ///< of the edge's line from the centre of rotation, along the normal [m]
    Eigen::Vector2d normal;
    double least, most;  ///< distance of the edge from the centre [m]
  };
  void layOutLine();
  void layOutTurn();
  Contact meetStraight(const Eigen::Vector2d& point, double radius) const;
  Contact meetTurning(const Eigen::Vector2d& point, double radius) const;
  /// In the way, unless it is beyond the look-ahead.
  Contact contact(double distance, double speed) const;
  /// Turn [rad] until the point is touched by the outline grown by `inflation`; kNever, kInside.
  double angleToTouch(const Eigen::Vector2d& point, double inflation) const;
  /// True: the outline grown by `inflation` does not come there within the look-ahead. Cheap.
  bool outOfSector(const Eigen::Vector2d& arm, double from_centre, double inflation) const;
  /// Turn [rad] until the foremost corner comes beside the point; 0: the robot is beside it. Only
  /// where the centre of rotation lies outside the footprint.
  double angleToLead(const Eigen::Vector2d& point) const;

  const Footprint& footprint_;
  Twist2 unit_;  ///< the twist with a path speed of 1
  bool moves_ = false;
  bool turns_ = false;
  double margin_, look_ahead_;
  Eigen::Vector2d direction_{1.0, 0.0};    ///< straight: of the motion
  double left_ = 0.0, right_ = 0.0;        ///< straight: reach of the footprint beside its line [m]
  double front_ = 0.0, rear_ = 0.0;        ///< straight: reach along it [m]
  Eigen::Vector2d centre_{0.0, 0.0};       ///< turning: of rotation
  double nearest_ = 0.0, farthest_ = 0.0;  ///< turning: of the footprint from the centre [m]
  std::vector<TurningEdge> turning_edges_;
  Eigen::Vector2d lead_{0.0, 0.0};  ///< from the centre to the corner that leads [m]
  double extent_ = 0.0;             ///< angle from there back to the last corner [rad]
  Eigen::Vector2d sector_{1.0,
                          0.0};  ///< turning: middle of what the outline sweeps, from the centre
  double sector_cos_ = -1.0;     ///< of half the angle of that
  double reach_ = 0.0;           ///< farthest corner from the base's origin [m]
  double mitre_ = 1.0;           ///< how much farther than by the inflation a corner grows
};

}  // namespace pilothouse
