#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/mapping/map_cells.hpp"
#include "core/pose/scan_matcher.hpp"

namespace pilothouse {

struct PointMapParameters {
  double cell = 0.05;        ///< side of the squares that hold one point each [m]
  double line_radius = 0.2;  ///< points so near a point say which line it lies on [m]; up to
                             ///< four times as far where they are sparse
  int most_sightings = 20;   ///< after so many scans a square's point stays where it is
  int fewest_sightings = 2;  ///< scans that must have met a square before it counts: what walks is
                             ///< met once; not asked of what the first scan met
  double behind = 0.2;  ///< a scan that meets what is so far behind a square saw through it [m]
  std::size_t most = 20'000;  ///< points; beyond, those farthest from the robot are forgotten
};

/// Points that scans have met, one a square: the mean of what was seen there. What a scan sees
/// through is no longer there: people walk on, chairs are moved.
class PointMap {
 public:
  explicit PointMap(const PointMapParameters& parameters) : parameters_(parameters) {}

  /// One scan.
  /// @param points in the base frame [m]. @param pose T_map_base, finite and within 10,000 km.
  /// @param from where the sensor sits, base frame [m].
  void add(const std::vector<Eigen::Vector2d>& points, const Pose2& pose,
           const Eigen::Vector2d& from = Eigen::Vector2d::Zero());
  void clear() {
    squares_.clear();
    scans_ = 0;
  }
  std::size_t size() const { return squares_.size(); }
  /// Those that count, with the line that each lies on; those that stand alone are left out, since
  /// what they were seen of may have been anywhere about.
  std::vector<MapPoint> points() const;

 private:
  struct Square {
    Eigen::Vector2d mean;
    int points;     ///< that made the mean
    int sightings;  ///< scans
    int scan;       ///< the last of them
    bool first;     ///< met by the first scan
  };
  static std::uint64_t keyOf(std::int32_t x, std::int32_t y) {
    return (std::uint64_t{static_cast<std::uint32_t>(x)} << 32) | static_cast<std::uint32_t>(y);
  }
  std::int32_t column(double place) const {
    return static_cast<std::int32_t>(std::floor(place / parameters_.cell));
  }
  bool counts(const Square& square) const {
    return square.first || square.sightings >= parameters_.fewest_sightings;
  }
  void meet(const Eigen::Vector2d& place);
  /// Takes a sighting off each square that was seen through.
  void seeThrough(const std::vector<Eigen::Vector2d>& points, const Pose2& pose,
                  const Eigen::Vector2d& from);
  /// With the line that the points about it form; nothing where too few are so near.
  std::optional<MapPoint> pointAt(const Eigen::Vector2d& place, double radius) const;
  void forgetFar(const Eigen::Vector2d& from);

  PointMapParameters parameters_;
  std::unordered_map<std::uint64_t, Square> squares_;
  int scans_ = 0;
};

/// The edges of what stands on a given map: the middles of occupied cells beside any that is not
/// occupied, each with the line that those around it form.
std::vector<MapPoint> edgesOf(const MapCells& map);

}  // namespace pilothouse
