#pragma once

#include <cmath>
#include <vector>

#include "core/pose/scan_points.hpp"
#include "sim/random.hpp"

namespace pilothouse {

/// A room of walls and a few boxes, as line segments.
struct SegmentRoom {
  struct Segment {
    Eigen::Vector2d a, b;
  };
  std::vector<Segment> segments;

  void box(double x, double y, double width, double depth) {
    const Eigen::Vector2d c[4] = {{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}};
    for (int i = 0; i < 4; ++i) segments.push_back({c[i], c[(i + 1) % 4]});
  }
  static SegmentRoom furnished() {
    SegmentRoom room;
    room.box(-4.0, -3.0, 8.0, 6.0);
    room.box(1.5, 1.0, 0.8, 0.5);
    room.box(-2.5, -2.0, 0.6, 0.9);
    room.box(2.8, -2.0, 0.4, 0.4);
    return room;
  }
  static SegmentRoom corridor() {
    SegmentRoom room;
    room.segments = {{{-50.0, -1.0}, {50.0, -1.0}}, {{-50.0, 1.0}, {50.0, 1.0}}};
    return room;
  }

  float range(const Pose2& from, double bearing) const {
    const Eigen::Vector2d direction(std::cos(from.heading + bearing),
                                    std::sin(from.heading + bearing));
    double nearest = INFINITY;
    for (const Segment& s : segments) {
      const Eigen::Vector2d along = s.b - s.a, to = s.a - from.position();
      const double cross = direction.x() * along.y() - direction.y() * along.x();
      if (std::abs(cross) < 1e-12) continue;
      const double t = (to.x() * along.y() - to.y() * along.x()) / cross;
      const double u = (to.x() * direction.y() - to.y() * direction.x()) / cross;
      if (t > 0.0 && u >= 0.0 && u <= 1.0) nearest = std::min(nearest, t);
    }
    return static_cast<float>(nearest);
  }

  /// A whole turn of 360 beams of a robot on its way.
  template <class PoseAt>
  ScanBeams scan(PoseAt pose_at, double stamp, double duration, sim::Random& random) const {
    ScanBeams beams{stamp, -3.14159265, 0.0174532925, duration / 360.0, 0.05, 12.0, {}};
    for (int i = 0; i < 360; ++i) {
      const Pose2 pose = pose_at(stamp + beams.time_increment * i);
      beams.ranges.push_back(range(pose, beams.angle_min + beams.angle_increment * i) +
                             static_cast<float>(0.01 * random.normal()));
    }
    return beams;
  }
};

}  // namespace pilothouse
