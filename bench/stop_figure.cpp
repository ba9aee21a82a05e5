#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "bench/stop_report.hpp"

namespace pilothouse::bench {
namespace {

const cv::Scalar kInk(40, 36, 32), kGrid(225, 222, 218), kDot(190, 110, 30), kLate(40, 30, 220);
constexpr int kLeft = 290, kWidth = 940, kRow = 26, kTop = 60;
constexpr double kShown = 0.6;  // [s]

/// Rows of dots over an axis of time.
class Strips {
 public:
  explicit Strips(int rows)
      : image_(kTop + rows * kRow + 60, kWidth, CV_8UC3, cv::Scalar::all(255)) {
    const int bottom = image_.rows - 50;
    for (int tenth = 0; tenth <= 6; ++tenth) {
      const int x = at(0.1 * tenth);
      cv::line(image_, {x, kTop - 10}, {x, bottom}, kGrid, 1);
      text(cv::format("%.1f s", 0.1 * tenth), {x - 16, bottom + 18}, 0.4);
    }
  }

  void headline(const std::string& words) { text(words, {16, 30}, 0.6); }
  void bar(double seconds, int from_row, int to_row, const std::string& name) {
    const int x = at(seconds);
    cv::line(image_, {x, kTop + from_row * kRow - 8}, {x, kTop + to_row * kRow - 8}, kLate, 1,
             cv::LINE_AA);
    text(name, {x - 22, kTop + from_row * kRow - 12}, 0.38);
  }
  void row(int number, const std::string& name, const std::vector<double>& times, double late) {
    const int y = kTop + number * kRow + 4;
    const std::string words =
        cv::format("%s  (%d, max %.0f ms)", name.c_str(), static_cast<int>(times.size()),
                   1000.0 * quantile(times, 1.0));
    text(words, {16, y + 4}, 0.4);
    int wobble = 0;
    for (const double time : times) {
      const double shown = std::isfinite(time) ? std::min(time, kShown) : kShown;
      wobble = (wobble + 5) % 11;
      cv::circle(image_, {at(shown), y + wobble - 5}, 3, time <= late ? kDot : kLate, -1,
                 cv::LINE_AA);
    }
  }
  const cv::Mat& image() const { return image_; }

 private:
  static int at(double seconds) {
    return kLeft + static_cast<int>(std::lround((kWidth - kLeft - 30) * seconds / kShown));
  }
  void text(const std::string& words, cv::Point place, double size) {
    cv::putText(image_, words, place, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
  }

  cv::Mat image_;
};

}  // namespace

void drawStops(const std::vector<StopResult>& faults,
               const std::vector<AppearanceResult>& appearances, const std::string& file) {
  std::map<std::string, std::vector<double>> kinds;
  for (const StopResult& result : faults) kinds[result.fault].push_back(result.to_zero);
  std::vector<double> appeared;
  for (const AppearanceResult& result : appearances)
    if (!result.beforehand) appeared.push_back(result.to_zero);
  const int rows = static_cast<int>(kinds.size());
  Strips strips(rows + 2);
  strips.headline(
      "Time from a fault to the zero command, and from an obstacle's first depth picture");
  strips.bar(0.35, 0, rows, "p99 0.35");
  strips.bar(0.5, 0, rows, "max 0.5");
  strips.bar(0.15, rows + 1, rows + 2, "p99 0.15");
  int row = 0;
  for (const auto& [fault, times] : kinds) strips.row(row++, fault, times, 0.35);
  if (!appeared.empty()) strips.row(rows + 1, "obstacle appears", appeared, 0.15);
  if (!cv::imwrite(file, strips.image())) throw std::runtime_error("cannot write '" + file + "'");
}

}  // namespace pilothouse::bench
