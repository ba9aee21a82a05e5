#include "bench/pose_figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/figure_canvas.hpp"
#include "bench/track_error.hpp"
#include "core/pose/pose_algebra.hpp"

namespace pilothouse::bench {
namespace {

constexpr int kWidth = 900, kHeight = 760, kTop = 84;

/// From places [m] to the canvas: the tracks fill it, y is up.
class View {
 public:
  void see(const std::vector<StampedPose>& track, const Pose2& T_view_track) {
    for (const auto& pose : track) bounds_.extend(T_view_track * pose.second.position());
  }
  void fit() {
    const Eigen::Vector2d size = bounds_.sizes() + Eigen::Vector2d(3.0, 3.0);
    scale_ = std::min(kWidth / size.x(), (kHeight - kTop) / size.y());
  }
  cv::Point2d operator()(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d from = place - bounds_.center();
    return {kWidth / 2 + scale_ * from.x(), kTop + (kHeight - kTop) / 2 - scale_ * from.y()};
  }
  double pixels(double metres) const { return scale_ * metres; }

 private:
  Eigen::AlignedBox2d bounds_;
  double scale_ = 1.0;
};

std::vector<cv::Point2d> lineOf(const View& view, const std::vector<StampedPose>& track,
                                const Pose2& T_view_track) {
  std::vector<cv::Point2d> line;
  for (const auto& pose : track) line.push_back(view(T_view_track * pose.second.position()));
  return line;
}

Pose2 alignmentOf(const std::vector<StampedPose>& track,
                  const std::vector<StampedPose>& reference) {
  std::vector<StampedPose> there, truth;
  pairUp(track, reference, there, truth);
  return there.size() < 2 ? Pose2{} : rigidAlignment(there, truth);
}

void legend(FigureCanvas& canvas, bool judged) {
  double x = 24.0;
  const auto entry = [&](const std::string& words, const cv::Scalar& colour) {
    canvas.line({x, 58.0}, {x + 26.0, 58.0}, colour, 2.5);
    canvas.text({x + 34.0, 63.0}, words, 14.0, ink::kText);
    x += 60.0 + FigureCanvas::textWidth(words, 14.0);
  };
  if (judged) entry("reference", ink::kPale);
  entry("odometry", ink::kOrange);
  entry("corrected", ink::kBlue);
}

}  // namespace

cv::Mat drawTracks(const PoseRecording& recording, const PoseReplay& tracks,
                   const std::string& title) {
  const Pose2 T_view_raw = alignmentOf(tracks.raw, recording.reference);
  const Pose2 T_view_map = alignmentOf(tracks.corrected, recording.reference);
  View view;
  view.see(tracks.raw, T_view_raw);
  view.see(tracks.corrected, T_view_map);
  view.fit();
  FigureCanvas canvas(kWidth, kHeight);
  canvas.clip({0.0, kTop, kWidth, kHeight - kTop});
  for (const MapPoint& point : tracks.map) {
    canvas.disc(view(T_view_map * point.position), 1.4, ink::kPale);
  }
  canvas.polyline(lineOf(view, recording.reference, {}), ink::kPale, 5.0);
  canvas.polyline(lineOf(view, tracks.raw, T_view_raw), ink::kOrange, 1.6);
  canvas.polyline(lineOf(view, tracks.corrected, T_view_map), ink::kBlue, 1.6);
  canvas.line({kWidth - 24.0 - view.pixels(1.0), kHeight - 20.0}, {kWidth - 24.0, kHeight - 20.0},
              ink::kText, 2.0);
  canvas.text({kWidth - 24.0 - view.pixels(0.5), kHeight - 28.0}, "1 m", 13.0, ink::kText,
              FigureCanvas::Anchor::kMiddle);
  canvas.clip({});
  canvas.text({24.0, 34.0}, title, 18.0, ink::kText, FigureCanvas::Anchor::kLeft, true);
  legend(canvas, !recording.reference.empty());
  return canvas.finished();
}

}  // namespace pilothouse::bench
