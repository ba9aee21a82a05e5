#include "bench/drive_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/drive_chart.hpp"
#include "bench/figure_canvas.hpp"
#include "bench/grid_picture.hpp"
#include "core/motion/swept_path.hpp"

namespace pilothouse::bench {
namespace {

using Anchor = FigureCanvas::Anchor;
using Eigen::Vector2d;

constexpr double kFarthestDepth = 5.0;  // colour of it [m]

/// World to pixels, and the drawing of one map.
class Map {
 public:
  Map(FigureCanvas& canvas, const cv::Rect2d& box, const cv::Rect2d& area)
      : canvas_(canvas),
        box_(box),
        scale_(std::min(box.width / area.width, box.height / area.height)),
        middle_(area.x + 0.5 * area.width, area.y + 0.5 * area.height) {}

  cv::Point2d at(const Vector2d& place) const {
    return {box_.x + 0.5 * box_.width + (place.x() - middle_.x) * scale_,
            box_.y + 0.5 * box_.height - (place.y() - middle_.y) * scale_};
  }
  std::vector<cv::Point2d> at(const std::vector<Vector2d>& places) const {
    std::vector<cv::Point2d> points;
    for (const auto& place : places) points.push_back(at(place));
    return points;
  }
  double scale() const { return scale_; }

  void ground(const DriveMoment& moment) {
    const GridGeometry& g = moment.geometry;
    for (int iy = 0; iy < g.size_y; ++iy) {
      for (int ix = 0; ix < g.size_x; ++ix) {
        const CellClass c = moment.classes[g.index(ix, iy)];
        if (c == CellClass::kUnknown) continue;
        const double half = 0.5 * static_cast<double>(g.cell_size);
        const double x = static_cast<double>(g.centreX(ix)), y = static_cast<double>(g.centreY(iy));
        std::vector<Vector2d> cell;
        for (const auto& [dx, dy] :
             {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
          cell.push_back(moment.pose * Vector2d(x + dx, y + dy));
        }
        canvas_.fill(at(cell), paleOf(c));
      }
    }
  }
  void metres() {
    const Vector2d low = placeAt({box_.x, box_.br().y}), high = placeAt({box_.br().x, box_.y});
    for (int x = static_cast<int>(std::ceil(low.x())); x <= high.x(); ++x) {
      canvas_.line(at(Vector2d(x, low.y())), at(Vector2d(x, high.y())), ink::kGrid);
      canvas_.text({at(Vector2d(x, 0)).x + 4, box_.br().y - 6}, std::to_string(x) + " m", 12,
                   ink::kPale);
    }
    for (int y = static_cast<int>(std::ceil(low.y())); y <= high.y(); ++y) {
      canvas_.line(at(Vector2d(low.x(), y)), at(Vector2d(high.x(), y)), ink::kGrid);
      canvas_.text({box_.x + 5, at(Vector2d(0, y)).y - 4}, std::to_string(y), 12, ink::kPale);
    }
  }
  /// Where the outline sweeps, and the margin beside it.
  void corridor(const Footprint& outline, const DriveMoment& moment, double margin, double ahead) {
    if (moment.way.zero()) return;
    for (const double wider : {margin, 0.0}) {
      std::vector<Vector2d> left, right;
      const SweptPath path(outline, moment.way, 0.0, ahead);
      for (double way = 0.0; way <= ahead; way += 0.05) {
        const Pose2 pose = path.poseAfter(way);
        const double turned = pose.heading + std::atan2(moment.way.vy, moment.way.vx);
        const Vector2d side(-std::sin(turned), std::cos(turned));
        double most = 0.0, least = 0.0;
        for (const auto& corner : outline.corners()) {
          const double off = side.dot(pose * corner - pose.position());
          most = std::max(most, off);
          least = std::min(least, off);
        }
        left.push_back(moment.pose * Vector2d(pose.position() + (most + wider) * side));
        right.push_back(moment.pose * Vector2d(pose.position() + (least - wider) * side));
      }
      left.insert(left.end(), right.rbegin(), right.rend());
      const cv::Scalar colour = wider > 0.0 ? ink::kOrange : ink::kRed;
      canvas_.fill(at(left), colour, wider > 0.0 ? 0.12 : 0.10);
      canvas_.polyline(at(left), colour, 1.0, true);
    }
  }
  void robot(const Footprint& outline, const Pose2& pose, bool solid) {
    std::vector<Vector2d> corners;
    for (const auto& corner : outline.corners()) corners.push_back(pose * corner);
    if (solid) canvas_.fill(at(corners), ink::kBlue, 0.85);
    canvas_.polyline(at(corners), solid ? ink::kText : ink::kPale, solid ? 1.6 : 0.8, true);
    if (!solid) return;
    const Vector2d nose = pose * Vector2d(0.18, 0.0), tail = pose * Vector2d(-0.1, 0.0);
    canvas_.line(at(tail), at(nose), ink::kPaper, 2.0);
    canvas_.line(at(nose), at(pose * Vector2d(0.08, 0.08)), ink::kPaper, 2.0);
    canvas_.line(at(nose), at(pose * Vector2d(0.08, -0.08)), ink::kPaper, 2.0);
  }
  void objects(const DriveMoment& moment) {
    for (const Relevance wanted :
         {Relevance::kOther, Relevance::kPotential, Relevance::kInTheWay}) {
      for (const auto& object : moment.surroundings.objects) {
        if (object.relevance != wanted) continue;
        const double radius = std::max(2.6, 0.5 * static_cast<double>(object.size) * scale_);
        canvas_.disc(at(moment.pose * Vector2d(object.position.cast<double>())), radius,
                     colourOf(wanted), !object.remembered, 1.2);
      }
    }
  }
  static cv::Scalar colourOf(Relevance relevance) {
    if (relevance == Relevance::kInTheWay) return ink::kRed;
    return relevance == Relevance::kPotential ? ink::kOrange : ink::kBlue;
  }

 private:
  static cv::Scalar paleOf(CellClass c) {
    switch (c) {
      case CellClass::kObstacle:
        return {205, 205, 245};
      case CellClass::kThreshold:
        return {190, 240, 250};
      case CellClass::kDropOff:
        return {235, 205, 230};
      default:
        return {226, 242, 226};
    }
  }
  Vector2d placeAt(cv::Point2d pixel) const {
    return {middle_.x + (pixel.x - box_.x - 0.5 * box_.width) / scale_,
            middle_.y - (pixel.y - box_.y - 0.5 * box_.height) / scale_};
  }
  FigureCanvas& canvas_;
  cv::Rect2d box_;
  double scale_;
  cv::Point2d middle_;
};

void drawMapLegend(FigureCanvas& canvas, double x, double y) {
  const auto word = [&](const std::string& text) {
    canvas.text({x + 10, y + 5}, text, 14, ink::kText);
    x += 10 + FigureCanvas::textWidth(text, 14) + 26;
  };
  canvas.disc({x, y}, 5, ink::kRed), word("in the way");
  canvas.disc({x, y}, 5, ink::kOrange), word("beside it");
  canvas.disc({x, y}, 5, ink::kBlue), word("other");
  canvas.disc({x, y}, 5, ink::kBlue, false, 1.4), word("remembered");
  canvas.line({x - 6, y}, {x + 14, y}, ink::kText, 2.0), x += 12, word("driven");
  canvas.dashed({{x - 6, y}, {x + 14, y}}, ink::kGreen, 2.0, 5), x += 12, word("route");
  canvas.fill(cv::Rect2d(x - 6, y - 6, 13, 13), {190, 190, 190}), word("truth");
}

void drawMap(FigureCanvas& canvas, const cv::Rect2d& box, const DriveRecord& record,
             const RobotDescription& robot, const DriveFigure& figure) {
  const Footprint outline = robot.outline();
  const DriveMoment& moment = record.moment;
  canvas.clip(box);
  Map map(canvas, box, figure.area);
  map.ground(moment);
  map.metres();
  for (const auto& corners : moment.outlines) {
    canvas.fill(map.at(corners), {190, 190, 190}, 0.7);
    canvas.polyline(map.at(corners), {110, 110, 110}, 1.0, true);
  }
  map.corridor(outline, moment, robot.avoidance.margin, figure.look_ahead);
  canvas.dashed(map.at(record.route), ink::kGreen, 1.6, 5);
  for (std::size_t i = 0; i < record.route.size(); ++i) {
    canvas.disc(map.at(record.route[i]), 4, ink::kGreen);
    canvas.text(map.at(record.route[i]) + cv::Point2d(7, -7), std::to_string(i + 1), 14,
                ink::kGreen);
  }
  std::vector<cv::Point2d> track;
  for (const auto& sample : record.samples) track.push_back(map.at(sample.pose.position()));
  map.robot(outline, record.samples.front().pose, false);
  map.robot(outline, record.samples.back().pose, false);
  canvas.polyline(track, ink::kText, 1.8);
  map.robot(outline, moment.pose, true);
  map.objects(moment);
  canvas.clip({});
  canvas.frame(box, ink::kPale);
  canvas.text({box.x, box.y - 9}, "map, camera's grid and objects [m]", 15, ink::kText);
  drawMapLegend(canvas, box.x + 6, box.br().y + 18);
}

void drawDepthPanel(FigureCanvas& canvas, const cv::Rect2d& box, const cv::Mat& depth) {
  canvas.text({box.x, box.y - 9}, "depth image", 15, ink::kText);
  canvas.picture(drawDepth(depth, kFarthestDepth), box, true);
  canvas.frame(box, ink::kPale);
  // The colours' key: the same mapping on a column of depths.
  cv::Mat key(256, 1, CV_16UC1);
  for (int i = 0; i < 256; ++i) {
    key.at<std::uint16_t>(i) =
        static_cast<std::uint16_t>(std::max(1.0, kFarthestDepth * 1000.0 * (255 - i) / 255.0));
  }
  const cv::Rect2d bar(box.br().x + 12, box.y, 16, box.height);
  canvas.picture(drawDepth(key, kFarthestDepth), bar, true);
  canvas.frame(bar, ink::kPale);
  for (int metre = 0; metre <= 5; ++metre) {
    canvas.text({bar.br().x + 5, bar.br().y - bar.height * metre / kFarthestDepth + 5},
                std::to_string(metre) + " m", 13, ink::kText);
  }
}

/// In lines of at most that width, broken after semicolons.
std::vector<std::string> wrapped(const std::string& text, double width, double pixels) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find("; ", from), text.size() - 1) + 1;
    const std::string piece = text.substr(from, end - from);
    if (FigureCanvas::textWidth(lines.back() + piece, pixels) > width) lines.emplace_back();
    lines.back() += lines.back().empty() && piece.front() == ' ' ? piece.substr(1) : piece;
    from = end;
  }
  return lines;
}

}  // namespace

cv::Mat drawDrive(const DriveRecord& record, const RobotDescription& robot,
                  const DriveFigure& figure) {
  FigureCanvas canvas(1600, 1170);
  canvas.text({40, 46}, figure.title, 26, ink::kText, Anchor::kLeft, true);
  canvas.text({40, 74}, "expected: " + figure.expected, 16, ink::kText);
  double y = 97;
  for (const auto& line : wrapped("seen: " + figure.seen, 1520, 14)) {
    canvas.text({40, y}, line, 14, ink::kText);
    y += 19;
  }
  canvas.text({1560, 46}, figure.pass ? "passed" : "MISSED", 22,
              figure.pass ? ink::kGreen : ink::kRed, Anchor::kRight, true);
  if (record.has_moment) {
    drawDepthPanel(canvas, {40, 162, 620, 465}, record.moment.depth);
    drawMap(canvas, {760, 162, 800, 465}, record, robot, figure);
  }
  drawDriveChart(canvas, {80, 710, 1480, 405}, record);
  return canvas.finished();
}

}  // namespace pilothouse::bench
