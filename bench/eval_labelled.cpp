/// Judges the floor methods on real organised clouds whose points are labelled by hand.
/// docs/evaluation.md defines what is counted.

#include <cstdio>
#include <cstring>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "bench/eval_options.hpp"
#include "bench/grid_picture.hpp"
#include "bench/json_line.hpp"
#include "bench/point_picture.hpp"
#include "bench/recorded_files.hpp"
#include "core/floor/floor_segmenter.hpp"
#include "core/floor/plane_search.hpp"
#include "core/floor/point_split.hpp"
#include "doors/message_views.hpp"
#include "nodelets/pcd_file.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kBar = 98.0;  // of the improved method's mean IoU [%]

const EvalCommand kCommand{
    "eval labelled",
    "Finds the surface in every organised PCD file with a field 'label' (0 invalid, 1-9 the\n"
    "surface, 20 and more objects) and compares 'not the surface' with the labels, point by "
    "point.\n"
    "Bar: mean IoU of the improved method at least 98 %.",
    {"--data", "--out"}};

/// The labels of the cloud, row by row; empty where it has none.
std::vector<std::uint32_t> labelsOf(const sensor_msgs::PointCloud2& cloud) {
  std::vector<std::uint32_t> labels;
  for (const auto& field : cloud.fields) {
    if (field.name != "label" || field.datatype != sensor_msgs::PointField::UINT32) continue;
    if (field.offset + sizeof(std::uint32_t) > cloud.point_step) continue;
    labels.resize(std::size_t{cloud.width} * cloud.height);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const std::size_t at =
          i / cloud.width * cloud.row_step + i % cloud.width * cloud.point_step + field.offset;
      std::memcpy(&labels[i], &cloud.data[at], sizeof(std::uint32_t));
    }
    return labels;
  }
  return labels;
}

FloorParameters parametersFor(FloorMethod method) {
  FloorParameters p;
  p.method = method;
  // Things of a hand's size on a table, seen from a metre: what stands out by a centimetre counts.
  p.cell_size = 0.03;
  p.step_height = 0.01;
  p.x_min = -0.5;
  p.range = 3.0;
  p.half_width = 1.5;
  p.obstacle_deviation = method == FloorMethod::kOriginal ? 0.015 : 0.008;
  p.threshold_deviation = 0.008;
  return p;
}

/// Points that are objects (20 and more) against points called obstacle or drop-off; a labelled
/// point that is left unknown is wrong whatever it is.
double iouOf(const std::vector<std::uint32_t>& labels, const std::vector<CellClass>& classes) {
  std::size_t both = 0, either = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) continue;
    const bool object = labels[i] >= 20;
    const bool wrong = classes[i] == CellClass::kUnknown;
    const bool called = wrong ? !object : !isDrivable(classes[i]);
    if (object && called) ++both;
    if (object || called) ++either;
  }
  return either > 0 ? 100.0 * static_cast<double>(both) / static_cast<double>(either) : 100.0;
}

struct MethodResult {
  double iou = 0.0;
  std::vector<CellClass> points;
};

MethodResult judge(const CloudView& cloud, const Eigen::Isometry3f& T, FloorMethod method,
                   const std::vector<std::uint32_t>& labels) {
  FloorSegmenter segmenter(parametersFor(method));
  const FloorCells& grid = segmenter.segment(cloud, T);
  MethodResult result;
  splitPoints(cloud, T, grid, segmenter.parameters(), result.points);
  result.iou = iouOf(labels, result.points);
  return result;
}

void draw(const CloudView& cloud, const std::vector<std::uint32_t>& labels,
          const MethodResult& original, const MethodResult& improved, const std::string& name,
          const std::string& file) {
  std::vector<CellClass> truth(labels.size(), CellClass::kUnknown);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] > 0) truth[i] = labels[i] >= 20 ? CellClass::kObstacle : CellClass::kFloor;
  }
  const cv::Mat depth = drawDepth(depthOf(cloud), 2.0);
  cv::Mat grey(depth.size(), CV_8UC3, cv::Scalar(40, 40, 40));
  char titles[2][64];
  std::snprintf(titles[0], sizeof titles[0], "original: IoU %.1f %%", original.iou);
  std::snprintf(titles[1], sizeof titles[1], "improved: IoU %.1f %%", improved.iou);
  const cv::Size size(560, 420);
  const std::vector<cv::Mat> panels = {
      panel(depth, "depth, red near, blue 2 m", size),
      panel(tint(grey, truth), "labels", size, classLegend()),
      panel(tint(grey, original.points), titles[0], size, classLegend()),
      panel(tint(grey, improved.points), titles[1], size, classLegend())};
  if (!cv::imwrite(file, sheet(panels, 2, name))) {
    throw std::runtime_error("cannot write '" + file + "'");
  }
}

struct Total {
  int frames = 0;
  int refused = 0;
  double original = 0.0, improved = 0.0;
};

void judgeFile(const std::filesystem::path& path, const EvalOptions& options, Total& total) {
  const sensor_msgs::PointCloud2 message = readPcd(path.string());
  const std::vector<std::uint32_t> labels = labelsOf(message);
  if (labels.empty() || message.height < 2) return;  // not for this evaluation
  const std::string name = nameUnder(options.data, path);
  const auto cloud = openView(message);
  JsonLine json;
  json.text("eval", "labelled").text("file", name);
  const auto plane = findFloorPlane(*cloud);
  ++total.frames;
  if (!plane) {  // counts as a frame with nothing right
    std::cout << json.text("refused", plane.reason()).str() << "\n";
    return;
  }
  const Eigen::Isometry3f T = mountingFromPlane(*plane);
  const MethodResult original = judge(*cloud, T, FloorMethod::kOriginal, labels);
  const MethodResult improved = judge(*cloud, T, FloorMethod::kImproved, labels);
  total.original += original.iou;
  total.improved += improved.iou;
  json.number("original", original.iou).number("improved", improved.iou);
  std::cout << json.number("camera_height", static_cast<double>(plane->height)).str() << "\n";
  if (options.out.empty()) return;
  draw(*cloud, labels, original, improved, name,
       options.out + "/" + pictureName(options.data, path));
}

int run(const EvalOptions& options) {
  if (options.data.empty()) refuse(kCommand, "--data is missing, expected a folder");
  Total total;
  for (const auto& path : filesUnder(options.data, ".pcd")) {
    try {
      judgeFile(path, options, total);
    } catch (const std::runtime_error& fault) {
      ++total.refused;
      std::cerr << "eval labelled: " << path.string() << ": " << fault.what() << "\n";
    }
  }
  if (total.frames == 0)
    refuse(kCommand, "no labelled organised PCD file under '" + options.data + "'");
  const double original = total.original / total.frames, improved = total.improved / total.frames;
  const bool pass = improved >= kBar && total.refused == 0;
  JsonLine json;
  json.text("eval", "labelled").truth("summary", true).truth("pass", pass);
  json.whole("frames", total.frames).whole("unreadable", total.refused);
  json.number("original_iou", original).number("improved_iou", improved).number("bar", kBar);
  std::cout << json.str() << std::endl;
  return pass ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runEval(kCommand, argc, argv, run);
}
