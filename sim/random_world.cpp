#include "sim/random_world.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/floor_plan.hpp"
#include "sim/furniture.hpp"
#include "sim/random.hpp"
#include "sim/shapes.hpp"

namespace pilothouse::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kWallHeight = 2.2, kWall = 0.1;
constexpr double kDoor = 1.5;           // wide enough for the route through it [m]
constexpr double kPersonRadius = 0.32;  // of the circle round somebody who turns on the spot [m]
constexpr double kAwayFromStart = 1.8;  // people and unexpected boxes keep this far off it [m]
constexpr int kAttempts = 40;

void check(bool good, const std::string& name, double value, const std::string& expected) {
  if (good) return;
  throw std::invalid_argument(name + " is " + std::to_string(value) + ", expected " + expected);
}

void check(const RandomWorldParameters& p) {
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  check(within(p.robot_radius, 0.1, 0.6), "robot_radius", p.robot_radius, "0.1 to 0.6");
  check(within(p.clearance, 0.0, 1.0), "clearance", p.clearance, "0 to 1");
  check(p.least_people >= 0 && p.least_people <= p.most_people, "least_people", p.least_people,
        "0 to most_people");
  check(p.most_people <= 10, "most_people", p.most_people, "up to 10");
  check(within(p.courtesy, 0.0, 10.0), "courtesy", p.courtesy, "0 to 10");
  check(within(p.blocked_share, 0.0, 1.0), "blocked_share", p.blocked_share, "0 to 1");
  check(within(p.ramp_share, 0.0, 1.0), "ramp_share", p.ramp_share, "0 to 1");
  check(within(p.sill_share, 0.0, 1.0), "sill_share", p.sill_share, "0 to 1");
  check(within(p.route_length, 2.0, 50.0), "route_length", p.route_length, "2 to 50");
}

class Builder {
 public:
  Builder(std::uint64_t seed, const RandomWorldParameters& parameters)
      : random_(seed),
        p_(parameters),
        size_(random_.uniform(5.0, 10.0), random_.uniform(5.0, 9.0)),
        plan_(size_),
        finishes_(out_.world.textures) {}

  /// False: the room is too full for a route. @param share of the furniture it shall have, 0..1.
  bool build(double share) {
    addRoom();
    addFurniture(share);
    if (!addRoute()) return false;
    addPeople();
    if (random_.chance(p_.blocked_share)) addUnexpectedBox();
    return true;
  }
  RandomWorld take() { return std::move(out_); }

 private:
  World& world() { return out_.world; }
  std::string numbered(const std::string& name) {
    return name + "_" + std::to_string(world().models.size());
  }
  Vector3f paint() {
    static const Vector3f kPaints[] = {{0.72F, 0.26F, 0.20F}, {0.22F, 0.42F, 0.60F},
                                       {0.34F, 0.54F, 0.34F}, {0.86F, 0.70F, 0.30F},
                                       {0.86F, 0.84F, 0.80F}, {0.40F, 0.34F, 0.44F}};
    return kPaints[random_.integer(0, 5)];
  }

  void addRoom() {
    const bool tiled = random_.chance(0.3);
    Model floor = modelAt("floor", {size_.x() / 2.0, size_.y() / 2.0, 0.0});
    floor.parts.push_back(finishes_.part("floor", planeMesh(Vector3d::UnitZ(), size_),
                                         Vector3d::Zero(), Vector3f::Ones(),
                                         tiled ? "tiles" : "wood"));
    world().models.push_back(std::move(floor));
    const Vector2d outer = size_ + Vector2d::Constant(2.0 * kWall);
    addWall({size_.x() / 2.0, -kWall / 2.0, 0.0}, outer.x());
    addWall({size_.x() / 2.0, size_.y() + kWall / 2.0, 0.0}, outer.x());
    addWall({-kWall / 2.0, size_.y() / 2.0, M_PI / 2.0}, size_.y());
    addWall({size_.x() + kWall / 2.0, size_.y() / 2.0, M_PI / 2.0}, size_.y());
    if (size_.x() > 7.0 && random_.chance(0.4)) return addInnerWall();
    if (random_.chance(p_.ramp_share)) return addRamp();
    if (random_.chance(p_.sill_share)) {
      const double heading = random_.uniform(0.0, M_PI);
      addSill(
          {random_.uniform(1.5, size_.x() - 1.5), random_.uniform(1.5, size_.y() - 1.5), heading},
          random_.uniform(0.8, 1.6));
    }
  }

  void addWall(const Pose2& middle, double length) {
    Model wall = modelAt(numbered("wall"), middle);
    addBox(wall, finishes_, {length, kWall, kWallHeight}, {0.92F, 0.89F, 0.83F}, "plaster");
    world().models.push_back(std::move(wall));
  }

  /// Across the room, with a door in it, and perhaps a sill in the door.
  void addInnerWall() {
    const double x = random_.uniform(0.4, 0.6) * size_.x();
    const double door = random_.uniform(0.6 + kDoor / 2.0, size_.y() - 0.6 - kDoor / 2.0);
    const double below = door - kDoor / 2.0, above = size_.y() - door - kDoor / 2.0;
    for (const auto& [middle, length] :
         {std::make_pair(below / 2.0, below), std::make_pair(size_.y() - above / 2.0, above)}) {
      addWall({x, middle, M_PI / 2.0}, length);
      plan_.addRectangle({x, middle, M_PI / 2.0}, {length, kWall});
    }
    door_.emplace(x, door);
    if (random_.chance(p_.sill_share)) addSill({x, door, M_PI / 2.0}, kDoor);
  }

  /// Drivable; across its pose's y.
  void addSill(const Pose2& middle, double length) {
    Model sill = modelAt(numbered("sill"), middle);
    addBox(sill, finishes_, {length, random_.uniform(0.04, 0.10), random_.uniform(0.008, 0.02)},
           {0.60F, 0.60F, 0.62F});
    world().models.push_back(std::move(sill));
  }

  /// A hump from wall to wall, so that nothing can drive over its sides.
  void addRamp() {
    const double height = random_.uniform(0.03, 0.09);
    const double run = height / std::tan(random_.uniform(3.5, 8.0) * M_PI / 180.0);
    const double level = random_.uniform(0.3, 0.8), half = run + level / 2.0;
    const double x = random_.uniform(0.4, 0.6) * size_.x();
    Model ramp = modelAt(numbered("ramp"), {x, size_.y() / 2.0, 0.0});
    addHump(ramp, finishes_, run, height, level, size_.y());
    world().models.push_back(std::move(ramp));
    ramp_.emplace(x - half - 0.1, x + half + 0.1);
  }

  void addFurniture(double share) {
    const double area = size_.x() * size_.y();
    const int count = static_cast<int>(share * area / random_.uniform(3.0, 7.0));
    for (int i = 0; i < count; ++i) addThing();
  }

  /// Puts one thing where there is room, if it finds some.
  void addThing() {
    Model model = modelAt("", {});
    Vector2d size;
    std::string name;
    const double kind = random_.unit();
    if (kind < 0.45) {
      const bool low = random_.chance(0.35);
      const Vector3d box(random_.uniform(0.12, 0.8), random_.uniform(0.12, 0.6),
                         low ? random_.uniform(0.07, 0.18) : random_.uniform(0.18, 1.2));
      const bool carton = random_.chance(0.5);
      addBox(model, finishes_, box, carton ? Vector3f::Ones().eval() : paint(),
             carton ? "cardboard" : "");
      size = box.head<2>();
      name = "box";
    } else if (kind < 0.65) {
      const double radius = random_.uniform(0.05, 0.3);
      addCylinder(model, finishes_, radius, random_.uniform(0.1, 1.2), paint());
      size = Vector2d::Constant(2.0 * radius);
      name = "cylinder";
    } else if (kind < 0.82) {
      const Vector3d top(random_.uniform(0.7, 1.6), random_.uniform(0.5, 0.9),
                         random_.uniform(0.45, 0.76));
      addTable(model, finishes_, top);
      size = top.head<2>();
      name = "table";
    } else {
      addChair(model, finishes_, paint());
      size = {0.44, 0.44};
      name = "chair";
    }
    place(std::move(model), name, size);
  }

  void place(Model model, const std::string& name, const Vector2d& size) {
    const double radius = size.norm() / 2.0;
    for (int attempt = 0; attempt < 20; ++attempt) {
      const Vector2d at(random_.uniform(radius, size_.x() - radius),
                        random_.uniform(radius, size_.y() - radius));
      const double heading = random_.chance(0.5) ? 0.0 : random_.uniform(-M_PI, M_PI);
      const bool on_ramp = ramp_ && at.x() > ramp_->x() - radius && at.x() < ramp_->y() + radius;
      const bool in_door = door_ && (at - *door_).norm() < kDoor + radius;
      if (on_ramp || in_door || plan_.clearance(at) < radius) continue;
      const Pose2 pose{at.x(), at.y(), heading};
      const std::string full_name = numbered(name);
      model.name = full_name;
      model.T_world_model = modelAt(full_name, pose).T_world_model;
      world().models.push_back(std::move(model));
      if (name == "cylinder") return plan_.addDisc(at, size.x() / 2.0);
      return plan_.addRectangle(pose, size);
    }
  }

  bool addRoute() {
    const double need = p_.robot_radius + p_.clearance;
    for (int attempt = 0; attempt < 30; ++attempt) {
      const Vector2d start(random_.uniform(need, size_.x() - need),
                           random_.uniform(need, size_.y() - need));
      if (ramp_ && start.x() > ramp_->x() - need && start.x() < ramp_->y() + need) continue;
      const auto route = plan_.routeFrom(start, need, p_.route_length);
      if (!route || length(*route) < 0.5 * std::min(p_.route_length, size_.minCoeff())) continue;
      route_ = *route;
      const Vector2d ahead = route_[1] - route_[0];
      world().start = {route_[0].x(), route_[0].y(), std::atan2(ahead.y(), ahead.x())};
      world().routes["route"] = route_;
      return true;
    }
    return false;
  }

  static double length(const std::vector<Vector2d>& route) {
    double sum = 0.0;
    for (std::size_t i = 1; i < route.size(); ++i) sum += (route[i] - route[i - 1]).norm();
    return sum;
  }

  /// A point of the route and its direction, so far along it.
  std::pair<Vector2d, Vector2d> alongRoute(double distance) const {
    for (std::size_t i = 1; i < route_.size(); ++i) {
      const Vector2d leg = route_[i] - route_[i - 1];
      if (distance <= leg.norm() || i + 1 == route_.size())
        return {route_[i - 1] + leg.normalized() * std::min(distance, leg.norm()),
                leg.normalized()};
      distance -= leg.norm();
    }
    return {route_.front(), Vector2d::UnitX()};
  }

  /// Distance of a point from the route.
  double fromRoute(const Vector2d& point) const {
    double nearest = HUGE_VAL;
    for (std::size_t i = 1; i < route_.size(); ++i) {
      const Vector2d leg = route_[i] - route_[i - 1];
      const double share = std::clamp(leg.dot(point - route_[i - 1]) / leg.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (route_[i - 1] + share * leg - point).norm());
    }
    return nearest;
  }

  void addPeople() {
    const int people = random_.integer(p_.least_people, p_.most_people);
    for (int i = 0; i < people; ++i)
      for (int attempt = 0; attempt < 30 && !addPerson(); ++attempt) {
      }
  }

  /// Somebody who walks across the route, to and fro.
  bool addPerson() {
    const auto [middle, along] = alongRoute(random_.unit() * length(route_));
    const double turn = random_.uniform(M_PI / 4.0, 3.0 * M_PI / 4.0);
    const Vector2d way = Eigen::Rotation2Dd(turn) * along;
    const auto reach = [&](const Vector2d& direction) {
      double far = 0.0;
      while (far < 3.0 && plan_.clearance(middle + (far + 0.05) * direction) > kPersonRadius &&
             (middle + (far + 0.05) * direction - route_.front()).norm() > kAwayFromStart)
        far += 0.05;
      return far;
    };
    const double back = reach(-way), ahead = reach(way);
    // They stop and turn well beside the route, not on it.
    if (std::min(back, ahead) < p_.robot_radius + p_.clearance + kPersonRadius) return false;
    if (fromRoute(middle - back * way) < kPersonRadius + 0.5) return false;
    if (fromRoute(middle + ahead * way) < kPersonRadius + 0.5) return false;
    const Vector2d from = middle - back * way, to = middle + ahead * way;
    const double out = std::atan2(way.y(), way.x()), home = wrapped(out + M_PI);
    const double walk = (to - from).norm() / random_.uniform(0.3, 0.9);
    const double pause = random_.uniform(0.8, 3.0);
    ActorPath path;
    double time = 0.0;
    const auto add = [&](double lasts, const Vector2d& at, double heading) {
      time += lasts;
      path.points.push_back({time, {at.x(), at.y(), heading}});
    };
    add(0.0, from, out);
    add(walk, to, out);
    add(pause, to, home);
    add(walk, from, home);
    add(pause, from, out);
    Model person = modelAt(numbered("person"), path.points.front().pose);
    person.parts = personParts(paint(), paint() * 0.5F);
    person.path = std::move(path);
    person.courtesy = p_.courtesy;
    world().models.push_back(std::move(person));
    return true;
  }

  /// On the route, wherever the route can be left.
  void addUnexpectedBox() {
    const double whole = length(route_);
    if (whole < kAwayFromStart + 0.6) return;
    const auto [at, along] = alongRoute(random_.uniform(kAwayFromStart, whole - 0.5));
    if ((at - route_.front()).norm() < kAwayFromStart) return;
    if (ramp_ && at.x() > ramp_->x() - 0.3 && at.x() < ramp_->y() + 0.3) return;
    Model box = modelAt("unexpected_box", {at.x(), at.y(), std::atan2(along.y(), along.x())});
    addBox(box, finishes_,
           {random_.uniform(0.2, 0.5), random_.uniform(0.3, 0.7), random_.uniform(0.15, 0.6)},
           Vector3f::Ones(), "cardboard");
    world().models.push_back(std::move(box));
    out_.blocked = true;
  }

  Random random_;
  RandomWorldParameters p_;
  Vector2d size_;
  FloorPlan plan_;
  RandomWorld out_;
  Finishes finishes_;
  std::optional<Vector2d> door_;
  std::optional<Vector2d> ramp_;  ///< from, to in x
  std::vector<Vector2d> route_;
};

}  // namespace

RandomWorld randomWorld(std::uint64_t seed, const RandomWorldParameters& parameters) {
  check(parameters);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Builder builder(mixSeed(seed, static_cast<std::uint64_t>(attempt)), parameters);
    if (!builder.build(1.0 - static_cast<double>(attempt) / kAttempts)) continue;
    RandomWorld out = builder.take();
    out.world.name = "random_" + std::to_string(seed);
    return out;
  }
  throw std::runtime_error("no random world with room for a route was found for seed " +
                           std::to_string(seed) + ": the clearance leaves no way");
}

}  // namespace pilothouse::sim
