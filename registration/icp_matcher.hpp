#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/pose/scan_matcher.hpp"

namespace pilothouse {

struct IcpParameters {
  double reach = 0.5;   ///< farthest that a point looks for the map, of a guess in doubt [m]
  double fine = 0.15;   ///< and at last; a point has a match where the map is so near [m]
  int iterations = 30;  ///< at most, of each of the two passes
  double scale = 0.05;  ///< a distance so large counts half (Cauchy's weight) [m]
  double least_rms =
      0.005;  ///< no match is taken for better: range noise, cells, the map's own [m]
  double least_turn = 0.001;  ///< spread of a heading at the least [rad]
  /// Neighbouring beams share their errors: the covariance of independent ones is multiplied by
  /// this.
  double correlation = 10.0;
};

/// Calls visit(key, value, low, high) for every number; iterations is an int.
template <class Parameters, class Visit>
void forEachIcpParameter(Parameters& p, Visit visit) {
  visit("reach", p.reach, 0.05, 5.0);
  visit("fine", p.fine, 0.02, 1.0);
  visit("iterations", p.iterations, 1, 200);
  visit("scale", p.scale, 0.005, 1.0);
  visit("least_rms", p.least_rms, 0.001, 0.2);
  visit("least_turn", p.least_turn, 0.0001, 0.2);
  visit("correlation", p.correlation, 1.0, 1000.0);
}

/// The iterative closest point of PCL, in the plane and from points to lines (Chen and Medioni,
/// 1991; Censi, ICRA 2008), to points where the map forms no line. The covariance is that of least
/// squares: what the scan's points do not hold stays open. What lies beyond a line's end has no
/// match (Turk and Levoy, 1994), else a scan of what is new would be drawn back upon what is known;
/// and no point looks farther than the guess is in doubt (Vizzo et al., KISS-ICP, 2023). On its way
/// the search is held by the guess; the last step, from there, is the scan's alone.
class IcpMatcher : public ScanMatcher {
 public:
  explicit IcpMatcher(const IcpParameters& parameters = {});
  ~IcpMatcher() override;
  void setTarget(const std::vector<MapPoint>& map) override;
  ScanMatch match(const std::vector<Eigen::Vector2d>& points, const Pose2& guess,
                  const Eigen::Matrix3d& spread) override;

 private:
  struct Pcl;
  std::unique_ptr<Pcl> pcl_;
};

}  // namespace pilothouse
