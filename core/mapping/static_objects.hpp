#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/mapping/camera_sight.hpp"
#include "core/mapping/occupancy_map.hpp"
#include "core/motion/local_memory.hpp"
#include "core/motion/obstacle.hpp"

namespace pilothouse {

/// What an operator must know is above the line; the rest has good defaults.
struct StaticParameters {
  double enter_time = 3.0;  ///< what was seen in its place for so long in all stays [s], 0.1..3600
  bool echoes = false;      ///< also what only a ranger met: of that just an arc is known
  // ---- advanced
  int gone_frames = 3;   ///< of so many frames in a row that show it gone it is cleared, 1..30
  double nearest = 0.8;  ///< nearer than this the camera measures nothing [m], 0..5
};

template <class Parameters, class Visit>
void forEachStaticParameter(Parameters& p, Visit visit) {
  visit("enter_time", p.enter_time, 0.1, 3600.0);
  visit("gone_frames", p.gone_frames, 1, 30);
  visit("nearest", p.nearest, 0.0, 5.0);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const StaticParameters& parameters);

/// Enters what keeps its place into the map (KTU 2014, step 9), and clears what has left: who walks
/// about leaves nothing. Looks at a window of 12.8 x 12.8 m round the robot. Fixed size: allocates
/// when made, and where a frame brings more than any before.
///
/// Seen gone is what stands in no cell of a frame, nor beside, where that frame shows
/// - floor in its place, and what lies behind it (else it may be the foot of a thing whose rest is
///   nearer than the camera sees); or
/// - with a camera's sight known: floor, where the camera could see the whole of it; or nothing at
///   all, where the camera could see the whole of it, nothing nearer hides it, and floor is seen
///   before it: then neither it nor what is behind sends anything back. Such a place is unknown
///   from then on, for nobody has seen its floor.
class StaticObjects {
 public:
  /// @throws std::invalid_argument listing every fault.
  explicit StaticObjects(const StaticParameters& parameters);
  /// Needed for what leaves nothing behind that could be seen.
  void setSight(const CameraSight& sight) { sight_ = sight; }

  // The pose is the base's in the map frame at the stamp [s]; stamps never go back (then clear()).

  /// Merged objects; remembered ones do not count, nor do thresholds and drop-offs, which the grid
  /// brings into the map by itself.
  void see(const std::vector<Obstacle>& objects, const Pose2& T_map_base, double stamp,
           OccupancyMap& map);
  /// A floor grid, for what it shows gone.
  void look(const FloorFrame& frame, const Pose2& T_map_base, OccupancyMap& map);
  /// What of the map stands in the window round a pose, one disc a cell, in the map frame.
  void collect(const Pose2& T_map_base, const OccupancyMap& map, std::vector<Obstacle>& out) const;
  /// Forgets what has not entered yet, e.g. when time jumps or the map changes.
  void clear();
  /// Cells that entered and that were cleared, since made.
  std::uint64_t entered() const { return entered_; }
  std::uint64_t cleared() const { return cleared_; }

 private:
  struct Track {
    std::int32_t ix = 0, iy = 0;  ///< which cell of the endless grid is kept here
    double last = -1.0;           ///< when something was seen here [s]; negative: never
    float seen = 0.0F;            ///< for how long in all [s]
    float height = 0.0F;          ///< of it [m]
    int gone = 0;                 ///< frames in a row that showed nothing
  };
  enum class Verdict { kNothing, kThere, kFloor, kEmpty };
  Track& at(CellPlace place);
  const Track* find(CellPlace place) const;
  Verdict judge(const FloorFrame& frame, const Eigen::Vector2d& p, float height) const;
  bool couldSee(const Eigen::Vector2d& p, float height) const;
  bool openBefore(const FloorFrame& frame, const Eigen::Vector2d& p) const;

  StaticParameters parameters_;
  std::optional<CameraSight> sight_;
  std::vector<Track> tracks_;
  std::vector<CellPlace> entering_, floor_, empty_;  ///< of one frame; reused
  std::uint64_t entered_ = 0, cleared_ = 0;
};

}  // namespace pilothouse
