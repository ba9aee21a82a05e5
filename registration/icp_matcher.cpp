#include "registration/icp_matcher.hpp"

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/pose/pose_algebra.hpp"

namespace pilothouse {
namespace {

// PCL's points: x, y in metres about the guess, so that single precision is enough anywhere. The
// curvature of the map's tells on which side of its normal its line ends: 1 left, -1 right, 0 none.
using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;
using Icp = pcl::IterativeClosestPoint<Point, Point, float>;
using Estimation = pcl::registration::TransformationEstimation<Point, Point, float>;

constexpr double kPastEnd = 0.05;     // so far beyond a line's end is no longer of it [m]
constexpr double kPointError = 0.02;  // of a scan's point, beside the guess [m]
constexpr double kSigmas = 3.0;       // a guess is no farther off

/// Normal equations of a small motion (x, y, heading about the origin).
struct Equations {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squares = 0.0;
  double weights = 0.0;

  void add(const Eigen::Vector2d& at, const Eigen::Vector2d& normal, double distance,
           double weight) {
    const Eigen::Vector3d row(normal.x(), normal.y(), at.x() * normal.y() - at.y() * normal.x());
    hessian += weight * row * row.transpose();
    gradient += weight * distance * row;
    squares += weight * distance * distance;
    weights += weight;
  }

  /// A scan's point and the map's that is nearest. @return false: it lies beyond that one's line.
  bool addPair(const Point& from, const Point& to, double scale) {
    const Eigen::Vector2d at(from.x, from.y), offset(to.x - from.x, to.y - from.y);
    const Eigen::Vector2d normal(to.normal_x, to.normal_y);
    const double past = to.curvature * (normal.y() * offset.x() - normal.x() * offset.y());
    if (past > kPastEnd) return false;
    if (normal.squaredNorm() > 0.5) {
      const double distance = normal.dot(offset);
      add(at, normal, distance, 1.0 / (1.0 + distance * distance / (scale * scale)));
      return true;
    }
    const double weight = 0.5 / (1.0 + offset.squaredNorm() / (scale * scale));
    add(at, Eigen::Vector2d::UnitX(), offset.x(), weight);
    add(at, Eigen::Vector2d::UnitY(), offset.y(), weight);
    return true;
  }

  /// With a trace of damping, so that a corridor's length stays where it was.
  Eigen::Vector3d solution() const {
    const Eigen::Matrix3d damped =
        hessian + 1e-6 * weights * Eigen::Matrix3d(Eigen::Vector3d(1, 1, 1).asDiagonal());
    return damped.ldlt().solve(gradient);
  }
};

Eigen::Matrix4f matrixOf(const Eigen::Vector3d& motion) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  const auto c = static_cast<float>(std::cos(motion.z())),
             s = static_cast<float>(std::sin(motion.z()));
  matrix.topLeftCorner<2, 2>() << c, -s, s, c;
  matrix(0, 3) = static_cast<float>(motion.x());
  matrix(1, 3) = static_cast<float>(motion.y());
  return matrix;
}

/// What is known of the scan's place beforehand.
class Guess {
 public:
  Guess() = default;
  /// @param robot where it is in the clouds. @param information of x, y, heading there.
  Guess(const Eigen::Vector2d& robot, const Eigen::Matrix3d& information)
      : robot_(robot), information_(information) {}

  /// Holds the robot where it was guessed to be.
  void addTo(Equations& equations) const {
    const Eigen::Vector2d now = moved_ * robot_;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn(0, 2) = -now.y();
    turn(1, 2) = now.x();
    const Eigen::Vector3d off(now.x() - robot_.x(), now.y() - robot_.y(), moved_.heading);
    equations.hessian += turn.transpose() * information_ * turn;
    equations.gradient -= turn.transpose() * information_ * off;
  }
  /// The scan was moved by so much about the clouds' origin.
  void moved(const Eigen::Vector3d& step) {
    moved_ = composed({step.x(), step.y(), step.z()}, moved_);
  }

 private:
  Eigen::Vector2d robot_ = Eigen::Vector2d::Zero();
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Pose2 moved_;  ///< since the guess, about the clouds' origin
};

/// One step of Gauss and Newton in the plane, which is what PCL's loop asks for.
class LineEstimation : public Estimation {
 public:
  LineEstimation(double scale, Guess& guess) : scale_(scale), guess_(guess) {}

  void estimateRigidTransformation(const Cloud& from, const Cloud& to,
                                   Matrix4& T_to_from) const override {
    T_to_from = step(from.size(), [&](std::size_t i, Equations& equations) {
      equations.addPair(from[i], to[i], scale_);
    });
  }
  void estimateRigidTransformation(const Cloud& from, const std::vector<int>& indices,
                                   const Cloud& to, Matrix4& T_to_from) const override {
    T_to_from = step(indices.size(), [&](std::size_t i, Equations& equations) {
      equations.addPair(from[static_cast<std::size_t>(indices[i])], to[i], scale_);
    });
  }
  void estimateRigidTransformation(const Cloud& from, const std::vector<int>& indices,
                                   const Cloud& to, const std::vector<int>& to_indices,
                                   Matrix4& T_to_from) const override {
    T_to_from = step(indices.size(), [&](std::size_t i, Equations& equations) {
      equations.addPair(from[static_cast<std::size_t>(indices[i])],
                        to[static_cast<std::size_t>(to_indices[i])], scale_);
    });
  }
  void estimateRigidTransformation(const Cloud& from, const Cloud& to,
                                   const pcl::Correspondences& pairs,
                                   Matrix4& T_to_from) const override {
    T_to_from = step(pairs.size(), [&](std::size_t i, Equations& equations) {
      equations.addPair(from[static_cast<std::size_t>(pairs[i].index_query)],
                        to[static_cast<std::size_t>(pairs[i].index_match)], scale_);
    });
  }

 private:
  template <class AddPair>
  Eigen::Matrix4f step(std::size_t pairs, const AddPair& addPair) const {
    Equations equations;
    for (std::size_t i = 0; i < pairs; ++i) addPair(i, equations);
    guess_.addTo(equations);
    const Eigen::Vector3d motion = equations.solution();
    guess_.moved(motion);
    return matrixOf(motion);
  }

  double scale_;
  Guess& guess_;
};

Point pointAt(const Eigen::Vector2d& place) {
  Point point;
  point.x = static_cast<float>(place.x());
  point.y = static_cast<float>(place.y());
  point.z = 0.0F;
  return point;
}

/// PCL prints an error for each scan that meets nothing of the map; the verdict tells that.
class Hushed {
 public:
  Hushed() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~Hushed() { pcl::console::setVerbosityLevel(before_); }

 private:
  pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

}  // namespace

struct IcpMatcher::Pcl {
  explicit Pcl(const IcpParameters& wanted) : parameters(wanted) {
    icp.setTransformationEstimation(Estimation::Ptr(new LineEstimation(wanted.scale, guess)));
    icp.setMaximumIterations(wanted.iterations);
    icp.setTransformationEpsilon(1e-8);
    icp.setEuclideanFitnessEpsilon(1e-9);
  }

  /// @param motion of the scan so far. @return whether the search came to an end.
  bool refine(double reach, Eigen::Matrix4f& motion) {
    icp.setMaxCorrespondenceDistance(reach);
    Cloud aligned;
    {
      const Hushed hushed;
      icp.align(aligned, motion);
    }
    motion = icp.getFinalTransformation();
    return icp.hasConverged() && motion.allFinite();
  }

  /// How well the scan lies after `motion`, and the last step from there, which the guess does not
  /// hold.
  void judge(const Cloud& scan, const Eigen::Matrix4f& motion, ScanMatch& match) const;

  IcpParameters parameters;
  Guess guess;
  Icp icp;
  Cloud::Ptr target;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< of the clouds, in the map
};

void IcpMatcher::Pcl::judge(const Cloud& scan, const Eigen::Matrix4f& motion,
                            ScanMatch& match) const {
  const auto tree = icp.getSearchMethodTarget();
  const float reach = static_cast<float>(parameters.fine * parameters.fine);
  Equations equations;
  std::vector<int> nearest(1);
  std::vector<float> squared(1);
  std::size_t matched = 0;
  for (const Point& point : scan) {
    Point moved = point;
    moved.getVector4fMap() = motion * point.getVector4fMap();
    if (tree->nearestKSearch(moved, 1, nearest, squared) < 1 || squared[0] > reach) continue;
    // About the robot: its heading's spread must not depend on where the map begins.
    moved.x -= motion(0, 3);
    moved.y -= motion(1, 3);
    Point to = (*target)[static_cast<std::size_t>(nearest[0])];
    to.x -= motion(0, 3);
    to.y -= motion(1, 3);
    if (equations.addPair(moved, to, parameters.scale)) ++matched;
  }
  match.overlap = static_cast<double>(matched) / static_cast<double>(scan.size());
  if (!(equations.weights > 0.0)) return;
  match.rms = std::sqrt(equations.squares / equations.weights);
  Eigen::Vector3d step = equations.solution();
  step *= std::min(1.0, parameters.fine / std::max(step.norm(), 1e-9));
  match.pose = {match.pose.x + step.x(), match.pose.y + step.y(),
                wrapped(match.pose.heading + step.z())};
  const double error = std::max(match.rms, parameters.least_rms);
  // What is not held at all gets a spread of kilometres instead of none.
  const Eigen::Matrix3d held = equations.hessian / (error * error * parameters.correlation) +
                               1e-6 * Eigen::Matrix3d::Identity();
  match.covariance = held.inverse();
  const double least = parameters.least_rms * parameters.least_rms;
  match.covariance.diagonal() +=
      Eigen::Vector3d(least, least, parameters.least_turn * parameters.least_turn);
}

IcpMatcher::IcpMatcher(const IcpParameters& parameters) : pcl_(std::make_unique<Pcl>(parameters)) {}
IcpMatcher::~IcpMatcher() = default;

void IcpMatcher::setTarget(const std::vector<MapPoint>& map) {
  pcl_->target.reset();
  if (map.empty()) return;
  pcl_->target.reset(new Cloud);
  pcl_->origin = map.front().position;
  for (const MapPoint& point : map) {
    pcl_->target->push_back(pointAt(point.position - pcl_->origin));
    pcl_->target->back().normal_x = static_cast<float>(point.normal.x());
    pcl_->target->back().normal_y = static_cast<float>(point.normal.y());
    const double side = point.normal.x() * point.beyond.y() - point.normal.y() * point.beyond.x();
    pcl_->target->back().curvature = static_cast<float>(side);
  }
  pcl_->icp.setInputTarget(pcl_->target);
}

ScanMatch IcpMatcher::match(const std::vector<Eigen::Vector2d>& points, const Pose2& guess,
                            const Eigen::Matrix3d& spread) {
  ScanMatch match;
  match.pose = guess;
  if (!pcl_->target || points.empty()) return match;
  const Cloud::Ptr scan(new Cloud);
  double arms = 0.0;
  for (const Eigen::Vector2d& point : points) {
    scan->push_back(pointAt(point));
    arms += point.squaredNorm() / static_cast<double>(points.size());
  }
  pcl_->icp.setInputSource(scan);
  const IcpParameters& p = pcl_->parameters;
  const Eigen::Vector2d start = guess.position() - pcl_->origin;
  pcl_->guess = Guess(start, kPointError * kPointError * p.correlation * spread.inverse());
  const double doubt = kSigmas * std::sqrt(spread(0, 0) + spread(1, 1) + spread(2, 2) * arms);
  const double reach = std::max(p.fine, std::min(p.reach, doubt));
  Eigen::Matrix4f motion = matrixOf({start.x(), start.y(), guess.heading});
  // PCL counts as not converged where too few points have a match: then the guess is no good.
  match.found = pcl_->refine(reach, motion) && pcl_->refine(p.fine, motion);
  if (!match.found) return match;
  match.pose = {pcl_->origin.x() + static_cast<double>(motion(0, 3)),
                pcl_->origin.y() + static_cast<double>(motion(1, 3)),
                std::atan2(static_cast<double>(motion(1, 0)), static_cast<double>(motion(0, 0)))};
  pcl_->judge(*scan, motion, match);
  return match;
}

}  // namespace pilothouse
