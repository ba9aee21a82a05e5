#include "bench/goal_figure.hpp"

#include <algorithm>
#include <cstdio>

#include "bench/figure_canvas.hpp"

namespace pilothouse::bench {
namespace {

constexpr int kWords = 900, kMargin = 16, kTop = 56;
constexpr double kMetre = 80.0;        // [pixels]
constexpr double kLine = 17.0;         // of words [pixels]
constexpr double kOutlineEvery = 0.5;  // [m]
const cv::Scalar kLacking(190, 180, 220), kKnown(90, 84, 80), kYellow(60, 200, 235);

class View {
 public:
  explicit View(const MapCells& map) : map_(map) {}
  int width() const { return static_cast<int>(map_.size_x * map_.cell_size * kMetre); }
  int height() const { return static_cast<int>(map_.size_y * map_.cell_size * kMetre); }
  cv::Point2d operator()(const Eigen::Vector2d& place) const {
    return {kMargin + kMetre * (place.x() - map_.origin_x),
            kTop + height() - kMetre * (place.y() - map_.origin_y)};
  }
  cv::Rect2d cell(const MapCells& map, int x, int y) const {
    const double half = 0.5 * map.cell_size;
    const cv::Point2d corner = (*this)({map.centreX(x) - half, map.centreY(y) + half});
    return {corner.x, corner.y, kMetre * map.cell_size, kMetre * map.cell_size};
  }

 private:
  const MapCells& map_;
};

void drawCells(FigureCanvas& canvas, const View& view, const GoalRecord& record) {
  for (int y = 0; y < record.marked.size_y; ++y) {
    for (int x = 0; x < record.marked.size_x; ++x) {
      const cv::Rect2d box = view.cell(record.marked, x, y);
      const Eigen::Vector2d place(record.marked.centreX(x), record.marked.centreY(y));
      const auto in = [&place](const MapCells& map) {
        return map.at(map.column(place.x()), map.row(place.y()));
      };
      const MapCell marked = record.marked.at(x, y);
      if (in(record.known) == MapCell::kOccupied) {
        canvas.fill(box, kKnown);
      } else if (in(record.whole) == MapCell::kOccupied) {
        canvas.fill(box, kLacking);
      }
      if (marked == in(record.known) || marked <= MapCell::kFree) continue;
      canvas.fill(box,
                  marked == MapCell::kOccupied    ? ink::kRed
                  : marked == MapCell::kThreshold ? kYellow
                                                  : ink::kOrange,
                  0.7);
    }
  }
}

void drawOutline(FigureCanvas& canvas, const View& view, const Footprint& outline,
                 const Pose2& pose, const cv::Scalar& colour) {
  std::vector<cv::Point2d> corners;
  for (const auto& corner : outline.corners()) corners.push_back(view(pose * corner));
  canvas.polyline(corners, colour, 1.2, true);
  canvas.line(view(pose.position()), view(pose * Eigen::Vector2d(0.2, 0.0)), colour, 1.6);
}

void drawWords(FigureCanvas& canvas, const GoalResult& result, double left) {
  double y = kTop + 4.0;
  for (const auto& said : result.record.said) {
    char when[24];
    std::snprintf(when, sizeof when, "%.1f s", said.first);
    canvas.text({left, y}, when, 12.0, ink::kPale);
    canvas.text({left + 70.0, y}, said.second, 12.0, ink::kText);
    y += kLine;
    if (y > canvas.height() - kLine) return;
  }
}

}  // namespace

cv::Mat drawGoal(const GoalResult& result) {
  const GoalRecord& record = result.record;
  const View view(record.known);
  const int height = std::max(view.height() + kTop + kMargin, 480);
  FigureCanvas canvas(view.width() + kWords + 3 * kMargin, height);
  char title[160];
  std::snprintf(title, sizeof title, "run %d, %s: %s", result.task.run,
                result.task.robot->name.c_str(), result.reached ? "reached" : "not reached");
  canvas.text({kMargin, 26.0}, title, 17.0, ink::kText, FigureCanvas::Anchor::kLeft, true);
  canvas.text({kMargin, 44.0},
              "known: dark; not in the map: pale; marked: red, steps orange, "
              "thresholds yellow",
              12.0, ink::kPale);
  drawCells(canvas, view, record);
  const Footprint outline = result.task.robot->outline();
  std::vector<cv::Point2d> trail;
  Eigen::Vector2d last(HUGE_VAL, HUGE_VAL);
  for (const Pose2& pose : record.trail) {
    trail.push_back(view(pose.position()));
    if (!((pose.position() - last).norm() < kOutlineEvery)) {
      drawOutline(canvas, view, outline, pose, ink::kGrid);
      last = pose.position();
    }
  }
  canvas.polyline(trail, ink::kBlue, 2.0);
  if (!record.trail.empty()) drawOutline(canvas, view, outline, record.trail.back(), ink::kBlue);
  const Pose2 goal{record.goal.place.x(), record.goal.place.y(), record.goal.heading.value_or(0.0)};
  drawOutline(canvas, view, outline, goal, ink::kGreen);
  drawWords(canvas, result, view.width() + 2.0 * kMargin);
  return canvas.finished();
}

}  // namespace pilothouse::bench
