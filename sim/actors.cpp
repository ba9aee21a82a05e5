#include "sim/actors.hpp"

#include <algorithm>
#include <cmath>

#include "sim/actor_path.hpp"
#include "sim/footprint_contact.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kElbows = 0.05;    ///< on both sides of an actor, room that they want [m]
constexpr double kForesight = 1.5;  ///< nobody steps where the robot will be by then [s]
constexpr double kRest = 20.0;      ///< who came back lets the robot go for so long [s]
constexpr double kRoom = 0.6;       ///< before a robot that people leave free [m]
constexpr double kStep = 0.1;       ///< [m]
constexpr double kStanding = 0.02;  ///< slower robots seem to stand [m/s]
constexpr double kPatience = 3.0;   ///< who has waited so long turns round [s]

double radiusOf(const Model& model) {
  double radius = 0.0;
  for (const Part& part : model.parts) {
    if (!part.solid) continue;
    for (const auto& vertex : part.mesh.vertices) {
      radius = std::max(radius, static_cast<double>(vertex.head<2>().norm()));
    }
  }
  return radius;
}

/// @param wide on either side [m].
Slice strip(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double wide) {
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d side = wide * Eigen::Vector2d(-along.y(), along.x());
  Slice slice;
  slice.count = 4;
  slice.corners = {from - side, to - side, to + side, from + side};
  return slice;
}

}  // namespace

/// The world must outlive its actors.
Actors::Actors(const World& world) {
  for (std::size_t i = 0; i < world.models.size(); ++i) {
    const Model& model = world.models[i];
    if (model.path) actors_.push_back({i, &model, radiusOf(model)});
  }
}

void Actors::step(WorldScene& scene, const Robot& robot, double dt) {
  for (Actor& actor : actors_) {
    if (!actor.walks) continue;
    if (actor.model->courtesy > 0.0 && robotAhead(actor, robot, dt)) {
      actor.waited += dt;
      if (actor.waited < kPatience && !robotComes(actor, robot)) continue;
      actor.waited = 0.0;
      actor.sense = -actor.sense;
      continue;
    }
    actor.waited = 0.0;
    walk(actor, dt);
    Pose2 pose = poseAt(*actor.model->path, actor.clock);
    if (actor.sense < 0.0) pose.heading = wrapped(pose.heading + M_PI);
    scene.place(actor.number, actorPose(*actor.model, pose));
  }
}

void Actors::walk(Actor& actor, double dt) {
  const ActorPath& path = *actor.model->path;
  const double first = path.points.front().time, last = path.points.back().time;
  if (actor.rest > 0.0) {
    actor.rest -= dt;
    return;
  }
  actor.clock += actor.sense * dt;
  if (path.loop && last > first && actor.clock > last) actor.clock -= last - first;
  if (actor.sense > 0.0 || actor.clock >= first) return;
  // Back where they began: they let the robot go first.
  actor.clock = first;
  actor.sense = 1.0;
  actor.rest = kRest;
}

void Actors::release(std::size_t model) {
  for (Actor& actor : actors_) {
    if (actor.number == model) actor.walks = false;
  }
}

/// Whether the robot reaches into what the actor is about to walk over, now or soon.
bool Actors::robotAhead(const Actor& actor, const Robot& robot, double dt) {
  const Pose2 now = poseAt(*actor.model->path, actor.clock);
  const Pose2 next = poseAt(*actor.model->path, actor.clock + actor.sense * dt);
  const Eigen::Vector2d way = next.position() - now.position();
  if (way.norm() < 1e-6) return false;
  const Eigen::Vector2d along = way.normalized(), at = now.position();
  const double wide = actor.radius + kElbows;
  const Eigen::Vector2d courteous = at + (actor.radius + actor.model->courtesy) * along;
  if (separation(robot.footprint, robot.pose, strip(at, courteous, wide)) <= 0.0) return true;

  // Where it will be soon, and the room before it, nobody enters; who is there walks on.
  if (reaches(robot, bodyOf(actor, now, along))) return false;
  return reaches(robot, strip(at, at + (actor.radius + kStep) * along, wide));
}

/// Whether the robot moves towards where the actor stands: nobody waits there.
bool Actors::robotComes(const Actor& actor, const Robot& robot) {
  if (robot.twist.linear() <= kStanding) return false;
  const Pose2 now = poseAt(*actor.model->path, actor.clock);
  return reaches(robot, bodyOf(actor, now, Eigen::Vector2d(1.0, 0.0)));
}

Slice Actors::bodyOf(const Actor& actor, const Pose2& pose, const Eigen::Vector2d& along) {
  const Eigen::Vector2d at = pose.position();
  return strip(at - actor.radius * along, at + actor.radius * along, actor.radius);
}

/// Whether the robot will be there soon, or has it in the room before it.
bool Actors::reaches(const Robot& robot, const Slice& place) {
  const Twist2 twist = robot.twist.linear() > kStanding ? robot.twist : Twist2{kStanding, 0.0, 0.0};
  const double seconds = std::max(kForesight, kRoom / twist.linear());
  for (double share = 0.25; share <= 1.0; share += 0.25) {
    const Pose2 pose = advanced(robot.pose, twist, share * seconds);
    if (separation(robot.footprint, pose, place) <= 0.0) return true;
  }
  return false;
}

}  // namespace pilothouse::sim
