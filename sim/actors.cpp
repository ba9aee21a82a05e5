#include "sim/actors.hpp"

#include <algorithm>
#include <cmath>

#include "sim/actor_path.hpp"
#include "sim/footprint_contact.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kElbows = 0.05;    ///< on both sides of an actor, room that they want [m]
constexpr double kForesight = 1.5;  ///< nobody steps where the robot will be by then [s]
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
      if (actor.waited < kPatience) continue;
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
  actor.clock += actor.sense * dt;
  if (actor.clock >= first) return;
  if (path.loop && last > first) {
    actor.clock += last - first;
  } else {
    actor.clock = first;
    actor.sense = 1.0;
  }
}

void Actors::release(std::size_t model) {
  for (Actor& actor : actors_) {
    if (actor.number == model) actor.walks = false;
  }
}

/// Whether the robot reaches into the strip that the actor is about to walk over, now or soon.
bool Actors::robotAhead(const Actor& actor, const Robot& robot, double dt) {
  const Pose2 now = poseAt(*actor.model->path, actor.clock);
  const Pose2 next = poseAt(*actor.model->path, actor.clock + actor.sense * dt);
  const Eigen::Vector2d way = next.position() - now.position();
  if (way.norm() < 1e-6) return false;
  const Eigen::Vector2d along = way.normalized(), across(-along.y(), along.x());
  const Eigen::Vector2d side = (actor.radius + kElbows) * across;
  const Eigen::Vector2d end = now.position() + (actor.radius + actor.model->courtesy) * along;
  Slice strip;
  strip.count = 4;
  strip.corners = {now.position() - side, end - side, end + side, now.position() + side};
  for (double ahead = 0.0; ahead <= kForesight; ahead += 0.25) {
    const Pose2 pose = advanced(robot.pose, robot.twist, ahead);
    if (separation(robot.footprint, pose, strip) <= 0.0) return true;
  }
  return false;
}

}  // namespace pilothouse::sim
