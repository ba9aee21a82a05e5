#include "sim/floor_scene_kinds.hpp"

#include <algorithm>
#include <cmath>

#include "sim/random.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kWholeView = 12.0;  // wider than the view at any distance that counts [m]

/// A rectangle on the ground: frame in its middle, half sizes.
struct Footprint {
  Eigen::Isometry2d T_base_middle;
  Eigen::Vector2d half;

  Eigen::Vector2d corner(int i) const {
    return T_base_middle * Eigen::Vector2d((i & 1) != 0 ? half.x() : -half.x(),
                                           (i & 2) != 0 ? half.y() : -half.y());
  }
  double nearestX() const {
    double x = corner(0).x();
    for (int i = 1; i < 4; ++i) x = std::min(x, corner(i).x());
    return x;
  }
};

/// Separating axes: true where one of a's edges has b wholly on its other side, `gap` away.
bool separatedBy(const Footprint& a, const Footprint& b, double gap) {
  for (int axis = 0; axis < 2; ++axis) {
    double low = 1e9, high = -1e9;
    for (int i = 0; i < 4; ++i) {
      const double along = (a.T_base_middle.inverse() * b.corner(i))[axis];
      low = std::min(low, along);
      high = std::max(high, along);
    }
    if (low > a.half[axis] + gap || high < -a.half[axis] - gap) return true;
  }
  return false;
}

Eigen::Isometry2d planar(double x, double y, double yaw) {
  return Eigen::Translation2d(x, y) * Eigen::Rotation2Dd(yaw);
}

Eigen::Isometry3d raised(const Eigen::Isometry2d& T) {
  Eigen::Isometry3d raised = Eigen::Isometry3d::Identity();
  raised.linear().topLeftCorner<2, 2>() = T.linear();
  raised.translation().head<2>() = T.translation();
  return raised;
}

/// Fills a scene while keeping its things apart.
class Builder {
 public:
  explicit Builder(std::uint64_t seed) : random_(seed) {}

  Random& random() { return random_; }
  FloorScene finish() { return std::move(scene_); }

  void addFloor() { scene_.solids.push_back(makeGround(0.0, Surface::kFloor)); }

  /// @param widest longest side on the ground [m]
  void addBoxes(int most, double lowest, double highest, double widest, Surface surface) {
    const int wanted = random_.integer(1, most);
    for (int i = 0; i < wanted; ++i) {
      const Eigen::Vector3d size(random_.uniform(0.07, widest), random_.uniform(0.07, widest),
                                 random_.uniform(lowest, highest));
      place(size, [&](const Eigen::Isometry3d& T) { return makeBox(T, size, surface); });
    }
  }

  void addSills(int most) {
    const int wanted = random_.integer(1, most);
    for (int i = 0; i < wanted; ++i) {
      const Eigen::Vector3d size(random_.uniform(0.03, 0.12), random_.uniform(0.8, 4.0),
                                 random_.uniform(0.005, 0.02));
      const double x = random_.uniform(0.8, 3.2);
      const double y = random_.uniform(-0.3, 0.3) * x;
      const Footprint footprint{planar(x, y, random_.uniform(-30.0, 30.0) * kDegree),
                                size.head<2>() / 2.0};
      if (!isFree(footprint)) continue;
      taken_.push_back(footprint);
      scene_.solids.push_back(makeBox(raised(footprint.T_base_middle), size, Surface::kSill));
    }
  }

  /// @return the frame of the slope: x uphill along it, z away from it, origin at its foot.
  Eigen::Isometry3d addRamp(double angle, double width) {
    const bool wide = width >= kWholeView;
    const double x = random_.uniform(1.0, 2.2);
    const double y = wide ? 0.0 : random_.uniform(-0.5, 0.5) * x;
    const Eigen::Isometry2d T = planar(x, y, random_.uniform(-15.0, 15.0) * kDegree);
    const double top = std::tan(angle) * random_.uniform(1.0, 2.5);
    scene_.solids.push_back(makeRamp(raised(T), angle, top, width));
    taken_.push_back({T * Eigen::Translation2d(6.0, 0.0), Eigen::Vector2d(6.0, width / 2.0)});
    return raised(T) * Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY());
  }

  void addBoxesOnSlope(const Eigen::Isometry3d& T_base_slope) {
    const int wanted = random_.integer(1, 2);
    for (int i = 0; i < wanted; ++i) {
      const double height =
          std::array<double, 3>{0.07, 0.18, 0.30}[static_cast<std::size_t>(random_.integer(0, 2))];
      const Surface surface = height < 0.1   ? Surface::kBox7cm
                              : height < 0.2 ? Surface::kBox18cm
                                             : Surface::kObstacle;
      // The second goes to the other side, so they never meet.
      const double y = random_.uniform(0.25, 0.6) * (i == 0 ? 1.0 : -1.0);
      const Eigen::Isometry3d T =
          T_base_slope * Eigen::Translation3d(random_.uniform(0.25, 0.8), y, 0.0) *
          Eigen::AngleAxisd(random_.uniform(-180.0, 180.0) * kDegree, Eigen::Vector3d::UnitZ());
      const Eigen::Vector3d size(random_.uniform(0.1, 0.3), random_.uniform(0.1, 0.3), height);
      scene_.solids.push_back(makeBox(T, size, surface));
    }
  }

  void addDropOff() {
    const double yaw = random_.uniform(-30.0, 30.0) * kDegree;
    scene_.edge =
        DropEdge{Eigen::Vector2d(std::cos(yaw), std::sin(yaw)), random_.uniform(1.2, 2.8)};
    scene_.solids.push_back(makeGround(*scene_.edge));
    scene_.solids.push_back(makeGround(-random_.uniform(0.07, 0.20), Surface::kLowerLevel));
  }

 private:
  bool isFree(const Footprint& wanted) const {
    constexpr double kGap = 0.15;      // so that each thing is judged by itself [m]
    constexpr double kNearest = 0.75;  // the floor before the robot is free [m]
    if (wanted.nearestX() < kNearest) return false;
    return std::all_of(taken_.begin(), taken_.end(), [&](const Footprint& other) {
      return separatedBy(wanted, other, kGap) || separatedBy(other, wanted, kGap);
    });
  }

  /// Tries some places in view; gives up rather than overlap.
  template <class Make>
  void place(const Eigen::Vector3d& size, Make make) {
    for (int attempt = 0; attempt < 50; ++attempt) {
      const double x = random_.uniform(0.9, 3.3);
      const double y = random_.uniform(-0.58, 0.58) * x;
      const Footprint footprint{planar(x, y, random_.uniform(-180.0, 180.0) * kDegree),
                                size.head<2>() / 2.0};
      if (!isFree(footprint)) continue;
      taken_.push_back(footprint);
      scene_.solids.push_back(make(raised(footprint.T_base_middle)));
      return;
    }
  }

  Random random_;
  FloorScene scene_;
  std::vector<Footprint> taken_;
};

}  // namespace

const char* nameOf(SceneKind kind) {
  switch (kind) {
    case SceneKind::kEmpty:
      return "empty";
    case SceneKind::kBoxes7cm:
      return "boxes_7cm";
    case SceneKind::kBoxes18cm:
      return "boxes_18cm";
    case SceneKind::kBoxes:
      return "boxes";
    case SceneKind::kRamp:
      return "ramp";
    case SceneKind::kBoxesOnRamp:
      return "boxes_on_ramp";
    case SceneKind::kSills:
      return "sills";
    case SceneKind::kMixed:
      return "mixed";
    case SceneKind::kDropOff:
      return "drop_off";
  }
  return "?";
}

FloorScene randomScene(SceneKind kind, std::uint64_t seed) {
  Builder build(seed);
  Random& random = build.random();
  if (kind != SceneKind::kDropOff) build.addFloor();
  switch (kind) {
    case SceneKind::kEmpty:
      break;
    case SceneKind::kBoxes7cm:
      build.addBoxes(6, 0.07, 0.07, 0.3, Surface::kBox7cm);
      break;
    case SceneKind::kBoxes18cm:
      build.addBoxes(6, 0.18, 0.18, 0.4, Surface::kBox18cm);
      break;
    case SceneKind::kBoxes:
      build.addBoxes(6, 0.05, 0.60, 0.5, Surface::kObstacle);
      break;
    case SceneKind::kRamp: {
      const double angle = random.uniform(3.0, 10.0) * kDegree;
      build.addRamp(angle, random.chance(0.5) ? kWholeView : random.uniform(0.8, 1.6));
      break;
    }
    case SceneKind::kBoxesOnRamp:
      build.addBoxesOnSlope(build.addRamp(8.0 * kDegree, kWholeView));
      break;
    case SceneKind::kSills:
      build.addSills(2);
      break;
    case SceneKind::kMixed:
      build.addRamp(random.uniform(3.0, 10.0) * kDegree, random.uniform(0.8, 1.2));
      build.addSills(1);
      build.addBoxes(1, 0.07, 0.07, 0.3, Surface::kBox7cm);
      build.addBoxes(1, 0.18, 0.18, 0.4, Surface::kBox18cm);
      build.addBoxes(1, 0.05, 0.60, 0.5, Surface::kObstacle);
      break;
    case SceneKind::kDropOff:
      build.addDropOff();
      break;
  }
  return build.finish();
}

}  // namespace pilothouse::sim
