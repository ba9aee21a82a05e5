#pragma once

#include "sim/world.hpp"

namespace pilothouse::sim {

/// Where an actor is at `time` of its own [s]; before the first point it stands there. A path that
/// loops jumps back to its first point: let it end there.
Pose2 poseAt(const ActorPath& path, double time);
/// World pose of an actor at the height its model has in the world's file.
Eigen::Isometry3d actorPose(const Model& actor, const Pose2& pose);

}  // namespace pilothouse::sim
