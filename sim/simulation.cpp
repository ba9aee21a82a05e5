#include "sim/simulation.hpp"

#include <cmath>
#include <sstream>

#include "sim/actor_path.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kLongestDelay = 5.0;  // of pictures under way, which take memory [s]

}  // namespace

Simulation::Simulation(World world, const SimRobot& robot, const SimulationParameters& parameters)
    : world_(std::move(world)),
      scene_(world_),
      actors_(world_),
      base_(robot, parameters.base, mixSeed(parameters.seed, 1)),
      sensors_(world_, robot, parameters.sensors, mixSeed(parameters.seed, 2)) {
  base_.place(scene_, world_.start);
}

const Readings& Simulation::step() {
  ++ticks_;
  const double now = time();
  const std::size_t contacts = base_.contacts().size();
  times_.measure(PartTimes::kActors, [&] {
    actors_.step(scene_, {base_.robot().footprint, base_.pose(), base_.twist()}, kTick);
    scene_.commit();
  });
  times_.measure(PartTimes::kBase, [&] { base_.step(scene_, now, kTick); });
  readings_.time = now;
  const auto begun = base_.contacts().begin() + static_cast<std::ptrdiff_t>(contacts);
  readings_.contacts.assign(begun, base_.contacts().end());
  sensors_.step(scene_, base_, ticks_, kTick, readings_, times_);
  return readings_;
}

std::optional<std::string> Simulation::fail(const std::string& sensor, FaultKind kind,
                                            double amount, double seconds) {
  std::ostringstream reason;
  const double most = kind == FaultKind::kDelay ? kLongestDelay : 1.0;
  if (!(amount >= 0.0 && amount <= most)) {
    reason << "amount is " << amount << ", expected 0 to " << most;
    return reason.str();
  }
  if (!(seconds >= 0.0 && std::isfinite(seconds))) {
    reason << "seconds is " << seconds << ", expected 0 or more";
    return reason.str();
  }
  Fault fault{kind, amount};
  if (seconds > 0.0) fault.until = time() + seconds;
  if (sensors_.fail(sensor, fault)) return std::nullopt;
  reason << "sensor is \"" << sensor << "\", expected all";
  for (const auto& name : sensors_.names()) reason << ", " << name;
  return reason.str();
}

std::optional<std::string> Simulation::place(const std::string& model, const Pose2& pose) {
  if (!pose.finite()) return "pose is not finite";
  if (model == "robot") {
    base_.place(scene_, pose);
    sensors_.restart();
    return std::nullopt;
  }
  for (std::size_t i = 0; i < world_.models.size(); ++i) {
    if (world_.models[i].name != model) continue;
    actors_.release(i);
    scene_.place(i, actorPose(world_.models[i], pose));
    scene_.commit();
    return std::nullopt;
  }
  return "model is \"" + model + "\", which world " + world_.name + " does not have";
}

FreeWay Simulation::freeDistance(double reach) {
  around_.collect(scene_, base_.robot(), base_.T_world_base(), reach);
  return around_.nearest(base_.robot().footprint);
}

FreeWay Simulation::freeAlong(const Twist2& twist, double farthest) {
  around_.collect(scene_, base_.robot(), base_.T_world_base(), farthest);
  return around_.along(base_.robot().footprint, twist, farthest);
}

const std::string& Simulation::nameOf(std::size_t model) const {
  static const std::string kDrop = "drop";
  return model == kNoModel ? kDrop : world_.models.at(model).name;
}

}  // namespace pilothouse::sim
