#include "bench/original_judging.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace pilothouse::bench {
namespace {

bool within(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& place) {
  std::vector<cv::Point2f> polygon;
  for (const auto& corner : outline) {
    polygon.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  }
  const cv::Point2f point(static_cast<float>(place.x()), static_cast<float>(place.y()));
  return polygon.size() >= 3 && cv::pointPolygonTest(polygon, point, false) >= 0.0;
}

}  // namespace

std::vector<Eigen::Vector2d> outlineOf(const sim::World& world, const std::string& model,
                                       double by) {
  for (const auto& candidate : world.models) {
    if (candidate.name != model) continue;
    std::vector<cv::Point2f> points;
    Eigen::Vector2d middle(0.0, 0.0);
    for (const auto& part : candidate.parts) {
      for (const auto& vertex : part.mesh.vertices) {
        const Eigen::Vector3d place = candidate.T_world_model * vertex.cast<double>();
        points.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()));
      }
    }
    std::vector<cv::Point2f> hull;
    cv::convexHull(points, hull);
    for (const auto& corner : hull) middle += Eigen::Vector2d(corner.x, corner.y);
    middle /= static_cast<double>(std::max<std::size_t>(1, hull.size()));
    std::vector<Eigen::Vector2d> outline;
    for (const auto& corner : hull) {
      // By the corner's coordinates: exact for boxes along the axes, near enough for turned ones.
      const Eigen::Vector2d arm = Eigen::Vector2d(corner.x, corner.y) - middle;
      outline.push_back(middle + arm + by * arm.cwiseSign());
    }
    return outline;
  }
  throw std::runtime_error("world " + world.name + " has no model " + model);
}

CellCount countCells(const DriveMoment& moment, const std::vector<Eigen::Vector2d>& outline) {
  CellCount count;
  const GridGeometry& g = moment.geometry;
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const Eigen::Vector2d centre(static_cast<double>(g.centreX(ix)),
                                   static_cast<double>(g.centreY(iy)));
      if (!within(outline, moment.pose * centre)) continue;
      const CellClass c = moment.classes[g.index(ix, iy)];
      if (c == CellClass::kUnknown) continue;
      ++count.known;
      if (c == CellClass::kFloor) ++count.floor;
      if (c == CellClass::kObstacle) ++count.obstacle;
    }
  }
  return count;
}

Judged judgedWithin(const DriveMoment& moment, const std::vector<Eigen::Vector2d>& outline) {
  Judged judged;
  for (const auto& object : moment.surroundings.objects) {
    if (!within(outline, moment.pose * Eigen::Vector2d(object.position.cast<double>()))) continue;
    judged.found = true;
    judged.relevance = std::max(judged.relevance, object.relevance);
  }
  return judged;
}

std::string nameOf(const Judged& judged) {
  if (!judged.found) return "not seen";
  if (judged.relevance == Relevance::kInTheWay) return "in the way";
  return judged.relevance == Relevance::kPotential ? "beside it" : "ignored";
}

}  // namespace pilothouse::bench
