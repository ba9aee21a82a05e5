#include "core/floor/plane_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <sstream>
#include <vector>

namespace pilothouse {
namespace {

constexpr std::size_t kCoarsePoints = 3000;
constexpr std::size_t kFinePoints = 20000;
constexpr int kNeighbourhood = 10;  // samples of a hypothesis lie at most this many samples apart
constexpr double kBelowPenalty = 2.0;

/// Points of a view on a regular pattern; x is NaN where there is none.
struct Samples {
  int columns = 0, rows = 0;
  std::vector<Eigen::Vector3f> points;
  std::size_t valid = 0;
};

Eigen::Vector3f pointOf(const CloudView& cloud, std::uint32_t row, std::uint32_t col) {
  return cloud.point(row, col);
}

Eigen::Vector3f pointOf(const DepthView& depth, std::uint32_t row, std::uint32_t col) {
  const float z = depth.metres(row, col);
  const Intrinsics& k = depth.intrinsics();
  return {static_cast<float>((col - k.cx) / k.fx) * z, static_cast<float>((row - k.cy) / k.fy) * z,
          z};
}

template <class View>
Samples sample(const View& view, std::size_t wanted, double max_depth) {
  const double pixels = static_cast<double>(view.width()) * view.height();
  const double spread = std::max(1.0, std::sqrt(pixels / static_cast<double>(wanted)));
  // An unorganised cloud is one row: the stride along it is the whole thinning.
  const double stride_row = view.height() == 1 ? 1.0 : spread;
  const double stride_col = view.height() == 1 ? spread * spread : spread;
  Samples samples;
  for (double row = 0.0; row < view.height(); row += stride_row) {
    ++samples.rows;
    samples.columns = 0;
    for (double col = 0.0; col < view.width(); col += stride_col) {
      ++samples.columns;
      Eigen::Vector3f p =
          pointOf(view, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(col));
      const bool valid = p.allFinite() && p.z() > 0.0F && p.z() <= static_cast<float>(max_depth);
      if (!valid) p.x() = std::nanf("");
      samples.valid += valid ? 1 : 0;
      samples.points.push_back(p);
    }
  }
  return samples;
}

bool isValid(const Eigen::Vector3f& p) {
  return !std::isnan(p.x());
}

/// A plane with its normal turned to the camera, if it can be the floor.
std::optional<FloorPlane> floorLike(Eigen::Vector3f normal, const Eigen::Vector3f& on_plane,
                                    const PlaneSearchParameters& parameters) {
  const float length = normal.norm();
  if (!(length > 1e-9F)) return std::nullopt;
  normal /= length;
  FloorPlane plane;
  plane.height = -normal.dot(on_plane);
  plane.normal = plane.height < 0.0F ? Eigen::Vector3f(-normal) : normal;
  plane.height = std::abs(plane.height);
  const Eigen::Vector3d up = plane.normal.cast<double>();
  const double pitch = pitchOf(up);
  if (up.y() >= 0.0 || pitch < parameters.min_pitch || pitch > parameters.max_pitch ||
      std::abs(rollOf(up)) > parameters.max_roll || plane.height < parameters.min_height ||
      plane.height > parameters.max_height) {
    return std::nullopt;
  }
  return plane;
}

float heightAbove(const FloorPlane& plane, const Eigen::Vector3f& p) {
  return plane.normal.dot(p) + plane.height;
}

/// Points on the plane, less a penalty for points below it. The noise of depth grows with its
/// square; half a centimetre a square metre is that of structured light seen at a slant.
double score(const Samples& samples, const FloorPlane& plane, float inlier) {
  int on = 0, below = 0;
  for (const Eigen::Vector3f& p : samples.points) {
    const float h = heightAbove(plane, p);
    const float tolerance = inlier + 0.002F * p.z() * p.z();
    if (std::abs(h) <= tolerance) ++on;
    if (h < -2.0F * tolerance) ++below;
  }
  return on - kBelowPenalty * below;
}

std::optional<FloorPlane> bestHypothesis(const Samples& samples,
                                         const PlaneSearchParameters& parameters) {
  std::mt19937_64 random(parameters.seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto at = [&](int row, int col) -> const Eigen::Vector3f& {
    return samples.points[static_cast<std::size_t>(row * samples.columns + col)];
  };
  std::optional<FloorPlane> best;
  double best_score = 0.0;
  for (int k = 0; k < parameters.hypotheses; ++k) {
    const int row = below(samples.rows), col = below(samples.columns);
    const auto near = [&](int centre, int count) {
      return std::clamp(centre + below(2 * kNeighbourhood + 1) - kNeighbourhood, 0, count - 1);
    };
    const Eigen::Vector3f& a = at(row, col);
    const Eigen::Vector3f& b = at(near(row, samples.rows), near(col, samples.columns));
    const Eigen::Vector3f& c = at(near(row, samples.rows), near(col, samples.columns));
    if (!isValid(a) || !isValid(b) || !isValid(c)) continue;
    const auto plane = floorLike((b - a).cross(c - a), a, parameters);
    if (!plane) continue;
    const double s = score(samples, *plane, static_cast<float>(parameters.inlier));
    if (s > best_score) {
      best_score = s;
      best = plane;
    }
  }
  return best;
}

/// Total least squares on the points near the plane, with a gate that narrows.
std::optional<FloorPlane> refine(const Samples& samples, FloorPlane plane,
                                 const PlaneSearchParameters& parameters) {
  for (const double factor : {2.0, 1.0, 0.7, 0.7}) {
    const auto gate = static_cast<float>(parameters.inlier * factor);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    std::size_t used = 0;
    for (const Eigen::Vector3f& p : samples.points) {
      if (!(std::abs(heightAbove(plane, p)) <= gate)) continue;
      const Eigen::Vector3d d = p.cast<double>();
      mean += d;
      square += d * d.transpose();
      ++used;
    }
    if (used < 50) return std::nullopt;
    mean /= static_cast<double>(used);
    const Eigen::Matrix3d covariance = square / static_cast<double>(used) - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const auto next =
        floorLike(solver.eigenvectors().col(0).cast<float>(), mean.cast<float>(), parameters);
    if (!next) return std::nullopt;
    plane = *next;
    plane.inlier_share = static_cast<float>(used) / static_cast<float>(samples.valid);
  }
  return plane;
}

template <class View>
Checked<FloorPlane> search(const View& view, const PlaneSearchParameters& parameters) {
  const Samples coarse = sample(view, kCoarsePoints, parameters.max_depth);
  std::ostringstream reason;
  if (coarse.valid < 100) {
    reason << "no floor found: " << coarse.valid << " of " << coarse.points.size()
           << " sampled points are valid and nearer than " << parameters.max_depth
           << " m, expected at least 100";
    return Checked<FloorPlane>::refused(reason.str());
  }
  if (const auto rough = bestHypothesis(coarse, parameters)) {
    const Samples fine = sample(view, kFinePoints, parameters.max_depth);
    if (const auto plane = refine(fine, *rough, parameters)) {
      if (plane->inlier_share >= parameters.min_share) return Checked<FloorPlane>::of(*plane);
      reason << "no floor found: the best plane holds " << plane->inlier_share * 100.0F
             << " % of the points, expected at least " << parameters.min_share * 100.0 << " %";
      return Checked<FloorPlane>::refused(reason.str());
    }
  }
  reason << "no floor found: no plane with pitch " << parameters.min_pitch << " to "
         << parameters.max_pitch << " rad and height " << parameters.min_height << " to "
         << parameters.max_height << " m";
  return Checked<FloorPlane>::refused(reason.str());
}

}  // namespace

double pitchOf(const Eigen::Vector3d& up) {
  return std::asin(std::clamp(-up.z(), -1.0, 1.0));
}
double rollOf(const Eigen::Vector3d& up) {
  return std::atan2(-up.x(), -up.y());
}

Checked<FloorPlane> findFloorPlane(const CloudView& cloud,
                                   const PlaneSearchParameters& parameters) {
  return search(cloud, parameters);
}

Checked<FloorPlane> findFloorPlane(const DepthView& depth,
                                   const PlaneSearchParameters& parameters) {
  return search(depth, parameters);
}

Eigen::Isometry3f mountingFromPlane(const FloorPlane& plane) {
  const Eigen::Vector3f up = plane.normal;
  // Looking straight down has no forward of its own: then the picture's upper edge is forward.
  const Eigen::Vector3f view =
      std::abs(up.z()) < 0.999F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f(0.0F, -1.0F, 0.0F);
  const Eigen::Vector3f forward = (view - view.dot(up) * up).normalized();
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear().row(0) = forward.transpose();
  T.linear().row(1) = up.cross(forward).transpose();
  T.linear().row(2) = up.transpose();
  T.translation() = Eigen::Vector3f(0.0F, 0.0F, plane.height);
  return T;
}

}  // namespace pilothouse
