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
  double cell = 0.05;         ///< side of the squares that hold one point each [m]
  double line_radius = 0.2;   ///< points so near a point say which line it lies on [m]; up to
                              ///< four times as far where they are sparse
  int most_sightings = 20;    ///< after so many a square's point stays where it is
  std::size_t most = 20'000;  ///< points; beyond, those farthest from the robot are forgotten
};

/// Points that scans have met, one a square: the mean of what was seen there.
class PointMap {
 public:
  explicit PointMap(const PointMapParameters& parameters) : parameters_(parameters) {}

  /// @param points in the base frame [m]. @param pose T_map_base, finite and within 10,000 km.
  void add(const std::vector<Eigen::Vector2d>& points, const Pose2& pose);
  void clear() { squares_.clear(); }
  std::size_t size() const { return squares_.size(); }
  /// The points with the line that each lies on; those that stand alone are left out, since what
  /// they were seen of may have been anywhere about.
  std::vector<MapPoint> points() const;

 private:
  struct Square {
    Eigen::Vector2d mean;
    int sightings;
  };
  static std::uint64_t keyOf(std::int32_t x, std::int32_t y) {
    return (std::uint64_t{static_cast<std::uint32_t>(x)} << 32) | static_cast<std::uint32_t>(y);
  }
  std::int32_t column(double place) const {
    return static_cast<std::int32_t>(std::floor(place / parameters_.cell));
  }
  std::optional<Eigen::Vector2d> normalAt(const Eigen::Vector2d& place, double radius) const;
  void forgetFar(const Eigen::Vector2d& from);

  PointMapParameters parameters_;
  std::unordered_map<std::uint64_t, Square> squares_;
};

/// The edges of what stands on a given map: the middles of occupied cells beside any that is not
/// occupied, each with the line that those around it form.
std::vector<MapPoint> edgesOf(const MapCells& map);

}  // namespace pilothouse
