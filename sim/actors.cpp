#include "sim/actors.hpp"

#include <algorithm>
#include <cmath>

#include "sim/actor_path.hpp"
#include "sim/footprint_contact.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kElbows = 0.05;  ///< on both sides of an actor, room that they want [m]

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

void Actors::step(WorldScene& scene, const Footprint& footprint, const Pose2& robot, double dt) {
  for (Actor& actor : actors_) {
    if (!actor.walks) continue;
    if (actor.model->courtesy > 0.0 && robotAhead(actor, footprint, robot, dt)) continue;
    actor.clock += dt;
    scene.place(actor.number, actorPose(*actor.model, poseAt(*actor.model->path, actor.clock)));
  }
}

void Actors::release(std::size_t model) {
  for (Actor& actor : actors_) {
    if (actor.number == model) actor.walks = false;
  }
}

/// Whether the robot reaches into the strip that the actor is about to walk over.
bool Actors::robotAhead(const Actor& actor, const Footprint& footprint, const Pose2& robot,
                        double dt) {
  const Pose2 now = poseAt(*actor.model->path, actor.clock);
  const Pose2 next = poseAt(*actor.model->path, actor.clock + dt);
  const Eigen::Vector2d way = next.position() - now.position();
  if (way.norm() < 1e-6) return false;
  const Eigen::Vector2d along = way.normalized(), across(-along.y(), along.x());
  const Eigen::Vector2d side = (actor.radius + kElbows) * across;
  const Eigen::Vector2d end = now.position() + (actor.radius + actor.model->courtesy) * along;
  Slice strip;
  strip.count = 4;
  strip.corners = {now.position() - side, end - side, end + side, now.position() + side};
  return separation(footprint, robot, strip) <= 0.0;
}

}  // namespace pilothouse::sim
