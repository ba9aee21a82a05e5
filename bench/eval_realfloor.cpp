/// Finds the floor in real pictures and compares it with planes measured before.
/// docs/evaluation.md defines what is counted.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "bench/eval_options.hpp"
#include "bench/floor_plane_list.hpp"
#include "bench/grid_picture.hpp"
#include "bench/json_line.hpp"
#include "bench/point_picture.hpp"
#include "bench/recorded_files.hpp"
#include "core/floor/floor_segmenter.hpp"
#include "core/floor/plane_search.hpp"
#include "core/floor/point_split.hpp"
#include "doors/message_views.hpp"
#include "nodelets/depth_folder.hpp"
#include "nodelets/pcd_file.hpp"

namespace pilothouse::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kHeightLimit = 0.02;  // [m]
constexpr double kTiltLimit = 1.0;     // [deg]
constexpr double kDegree = 0.017453292519943295;

const EvalCommand kCommand{
    "eval realfloor",
    "Finds the floor plane in the depth pictures and PCD files that floor_planes.txt under DIR\n"
    "lists and compares camera height and tilt. Bars: 2 cm and 1 degree a frame.",
    {"--data", "--out"}};

struct Total {
  int frames = 0, met = 0, absent = 0;
  double worst_height = 0.0;  ///< [m]
  double worst_tilt = 0.0;    ///< [deg]
};

/// The file that a list names: beside the list, in the folder above, or else any file of that name
/// under the folder.
fs::path findListed(const KnownPlane& plane, const fs::path& list, const std::string& folder) {
  for (const fs::path& root : {list.parent_path(), list.parent_path() / ".."}) {
    if (fs::is_regular_file(root / plane.file)) return (root / plane.file).lexically_normal();
  }
  const std::string name = fs::path(plane.file).filename().string();
  for (const fs::path& file : filesUnder(folder, name)) {
    if (file.filename() == name) return file;
  }
  return {};
}

/// Tilt as the list has it: of the picture's vertical axis against the floor's normal, seen from
/// the side. With no roll it is the pitch of the view axis [deg].
double tiltOf(const Eigen::Vector3d& up_in_optical) {
  return std::atan2(-up_in_optical.z(), -up_in_optical.y()) / kDegree;
}

template <class View>
void draw(const View& view, const FloorPlane& plane, const cv::Mat& colour,
          const std::string& headline, const std::string& file) {
  const Eigen::Isometry3f T = mountingFromPlane(plane);
  FloorParameters parameters;
  FloorSegmenter improved(parameters);
  const FloorCells& grid = improved.segment(view, T);
  std::vector<CellClass> points;
  splitPoints(view, T, grid, parameters, points);
  parameters.method = FloorMethod::kOriginal;
  FloorSegmenter original(parameters);
  const cv::Mat depth = drawDepth(depthOf(view), 4.0);
  const cv::Mat& picture = colour.empty() ? depth : colour;
  const cv::Size size(560, 440);
  const std::vector<cv::Mat> panels = {
      panel(depth, "depth, red near, blue 4 m", size),
      panel(tint(picture, points), "improved, point by point", size, classLegend()),
      panel(drawClasses(original.segment(view, T).geometry, original.segment(view, T).classes, 5),
            "original, from above", size, classLegend()),
      panel(drawClasses(grid.geometry, grid.classes, 5), "improved, from above", size,
            classLegend())};
  if (!cv::imwrite(file, sheet(panels, 2, headline))) {
    throw std::runtime_error("cannot write '" + file + "'");
  }
}

/// Compares the plane found in the view with the known one, prints and draws.
template <class View>
void judge(const View& view, const cv::Mat& colour, const KnownPlane& known, const fs::path& path,
           const EvalOptions& options, Total& total) {
  const std::string name = nameUnder(options.data, path);
  JsonLine json;
  json.text("eval", "realfloor").text("file", name);
  const auto plane = findFloorPlane(view);
  ++total.frames;
  if (!plane) {
    std::cout << json.text("refused", plane.reason()).truth("met", false).str() << "\n";
    return;
  }
  const Eigen::Vector3d up = plane->normal.template cast<double>();
  const double tilt = tiltOf(up);
  const double height_error = std::abs(static_cast<double>(plane->height) - known.height);
  const double tilt_error = std::abs(tilt - known.tilt);
  const double angle = std::acos(std::clamp(up.dot(known.normal), -1.0, 1.0)) / kDegree;
  const bool met = height_error <= kHeightLimit && tilt_error <= kTiltLimit;
  if (met) ++total.met;
  total.worst_height = std::max(total.worst_height, height_error);
  total.worst_tilt = std::max(total.worst_tilt, tilt_error);
  json.number("height", static_cast<double>(plane->height)).number("known_height", known.height);
  json.number("tilt_deg", tilt, 2).number("known_tilt_deg", known.tilt, 2);
  json.number("height_error_mm", height_error * 1000.0, 1).number("tilt_error_deg", tilt_error, 2);
  json.number("angle_between_normals_deg", angle, 2);
  std::cout << json.truth("met", met).str() << "\n";
  if (options.out.empty()) return;
  char headline[256];
  std::snprintf(headline, sizeof headline,
                "%s: camera %.3f m high (known %.3f), %.1f degrees down (%.1f)", name.c_str(),
                static_cast<double>(plane->height), known.height, tilt, known.tilt);
  draw(view, *plane, colour, headline, options.out + "/" + pictureName(options.data, path));
}

/// The picture of a colour message, which is borrowed.
cv::Mat pictureOf(const sensor_msgs::Image& image) {
  if (image.data.empty()) return {};
  return cv::Mat(static_cast<int>(image.height), static_cast<int>(image.width), CV_8UC3,
                 const_cast<std::uint8_t*>(image.data.data()), image.step);
}

void judgeDepth(const fs::path& path, const KnownPlane& known, const EvalOptions& options,
                Total& total) {
  const DepthFolder folder(path.parent_path().string());
  for (std::size_t i = 0; i < folder.frames().size(); ++i) {
    if (folder.frames()[i].depth != path.filename().string()) continue;
    const DepthFrame frame = folder.read(i);
    const auto view = openView(frame.depth, folder.info());
    if (!view) throw std::runtime_error(view.reason());
    judge(*view, pictureOf(frame.colour), known, path, options, total);
  }
}

void judgeListed(const KnownPlane& known, const fs::path& path, const EvalOptions& options,
                 Total& total) {
  if (path.extension() != ".pcd") return judgeDepth(path, known, options, total);
  const sensor_msgs::PointCloud2 cloud = readPcd(path.string());
  const auto view = openView(cloud);
  if (!view) throw std::runtime_error(view.reason());
  judge(*view, cv::Mat(), known, path, options, total);
}

int run(const EvalOptions& options) {
  if (options.data.empty()) refuse(kCommand, "--data is missing, expected a folder");
  const auto lists = filesUnder(options.data, "floor_planes.txt");
  if (lists.empty()) refuse(kCommand, "no floor_planes.txt under '" + options.data + "'");
  Total total;
  for (const fs::path& list : lists) {
    const auto planes = readKnownPlanes(list.string());
    if (!planes) refuse(kCommand, planes.reason());
    for (const KnownPlane& known : *planes) {
      const fs::path path = findListed(known, list, options.data);
      if (path.empty()) {
        ++total.absent;
        std::cerr << "eval realfloor: skipped " << known.file << ": listed but not there\n";
        continue;
      }
      judgeListed(known, path, options, total);
    }
  }
  if (total.frames == 0)
    refuse(kCommand, "none of the listed files is under '" + options.data + "'");
  const bool pass = total.met == total.frames;
  JsonLine json;
  json.text("eval", "realfloor").truth("summary", true).truth("pass", pass);
  json.whole("frames", total.frames).whole("met", total.met).whole("absent", total.absent);
  json.number("worst_height_error_mm", total.worst_height * 1000.0, 1);
  json.number("worst_tilt_error_deg", total.worst_tilt, 2);
  json.number("height_bar_mm", kHeightLimit * 1000.0, 1).number("tilt_bar_deg", kTiltLimit, 2);
  std::cout << json.str() << std::endl;
  return pass ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runEval(kCommand, argc, argv, run);
}
