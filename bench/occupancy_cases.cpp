#include <cmath>
#include <memory>

#include "bench/map_cases.hpp"
#include "bench/standard_frame.hpp"
#include "core/floor/floor_segmenter.hpp"
#include "core/mapping/occupancy_map.hpp"
#include "core/mapping/occupancy_reference.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kFrameMs = 1.0;  // a frame with its clearing
constexpr int kBeams = 640;

/// The standard frame's floor, a scan of a room, and a robot that goes round in it.
struct MappedFrame {
  MappedFrame() {
    const StandardFrame standard;
    FloorSegmenter segmenter{FloorParameters{}};
    cells = segmenter.segment(standard.depth(), standard.T_base_optical());
    for (int i = 0; i < kBeams; ++i) {
      // The walls of a room of 8 x 6 m, a door that is open, and what sends nothing back.
      const double angle = 2.0 * M_PI * i / kBeams;
      const double wall =
          std::min(4.0 / std::abs(std::cos(angle)), 3.0 / std::abs(std::sin(angle)));
      const bool open = i % 50 < 5;
      ranges.push_back(open ? HUGE_VALF : static_cast<float>(wall));
    }
    scan.angle_min = -M_PI;
    scan.increment = 2.0 * M_PI / kBeams;
    scan.range_min = 0.1;
    scan.range_max = 10.0;
    scan.ranges = ranges.data();
    scan.count = ranges.size();
  }
  FloorFrame frame() const {
    return {0.0, cells.geometry, cells.classes.data(), cells.heights.data()};
  }
  Pose2 next() {
    const double t = 0.033 * (step++ % 400);
    return {0.5 * std::cos(t), 0.5 * std::sin(t), 0.7 * t};
  }

  FloorCells cells;
  std::vector<float> ranges;
  PlanarScan scan;
  int step = 0;
};

template <class Map>
struct Learning {
  MappedFrame frame;
  Map map{OccupancyParameters{}};
  void floor() { map.addFloor(frame.frame(), frame.next()); }
  void scan() { map.addScan(frame.scan, frame.next()); }
  void both() {
    const Pose2 pose = frame.next();
    map.addFloor(frame.frame(), pose);
    map.addScan(frame.scan, pose);
  }
};

}  // namespace

void addOccupancyCases(std::vector<TimedCase>& cases) {
  const auto fast = std::make_shared<Learning<OccupancyMap>>();
  const auto plain = std::make_shared<Learning<OccupancyReference>>();
  for (int i = 0; i < 400; ++i) fast->both();  // grown
  cases.push_back(
      {"occupancy, floor grid and 640 beams", [fast] { fast->both(); }, {}, false, kFrameMs});
  cases.push_back({"occupancy, floor grid", [fast] { fast->floor(); }, {}, false, std::nullopt});
  cases.push_back({"occupancy, 640 beams", [fast] { fast->scan(); }, {}, false, std::nullopt});
  cases.push_back({"occupancy, floor grid and 640 beams (plain)",
                   [plain] { plain->both(); },
                   {},
                   true,
                   std::nullopt});
  const auto cells = std::make_shared<MapCells>();
  cases.push_back({"occupancy, snapshot",
                   [fast, cells] { fast->map.snapshot(*cells); },
                   {},
                   false,
                   std::nullopt});
}

}  // namespace pilothouse::bench
