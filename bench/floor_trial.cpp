#include "bench/floor_trial.hpp"

#include <algorithm>
#include <cmath>

#include "core/floor/floor_segmenter.hpp"
#include "sim/depth_noise.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr int kCalibrationFrames = 30;
const sim::Mounting kConfigured{0.65, 26.0 * kDegree, 0.0};

/// Where the camera truly hangs.
sim::Mounting trueMounting(const FloorTask& task, std::uint64_t seed) {
  sim::Random random(seed);
  const bool off = task.calibrating || task.kind == sim::SceneKind::kMixed;
  const double angle = !off ? 0.0 : task.calibrating ? 3.0 * kDegree : 1.0 * kDegree;
  const double height = !off ? 0.0 : task.calibrating ? 0.02 : 0.01;
  sim::Mounting mounting = kConfigured;
  mounting.pitch += random.uniform(-angle, angle);
  mounting.roll += random.uniform(-angle, angle);
  mounting.height += random.uniform(-height, height);
  return mounting;
}

DepthView viewOf(const std::vector<std::uint16_t>& image, const sim::CameraModel& camera) {
  DepthBytes bytes{};
  bytes.width = bytes.info_width = camera.width;
  bytes.height = bytes.info_height = camera.height;
  bytes.step = camera.width * 2;
  bytes.encoding = "16UC1";
  bytes.data = reinterpret_cast<const std::uint8_t*>(image.data());
  bytes.size = image.size() * 2;
  bytes.intrinsics = camera.intrinsics;
  return *DepthView::open(bytes);
}

/// The same measurements as a cloud of x y z and padding, NaN where there are none.
std::vector<float> cloudOf(const std::vector<std::uint16_t>& image,
                           const sim::CameraModel& camera) {
  std::vector<float> cloud(image.size() * 4, std::nanf(""));
  const Intrinsics& k = camera.intrinsics;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (image[i] == 0) continue;
    const double z = image[i] * 0.001;
    cloud[4 * i] = static_cast<float>((static_cast<double>(i % camera.width) - k.cx) / k.fx * z);
    cloud[4 * i + 1] =
        static_cast<float>((static_cast<double>(i / camera.width) - k.cy) / k.fy * z);
    cloud[4 * i + 2] = static_cast<float>(z);
  }
  return cloud;
}

CloudView viewOf(const std::vector<float>& cloud, const sim::CameraModel& camera) {
  static constexpr CloudField kFields[] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
  CloudBytes bytes{};
  bytes.width = camera.width;
  bytes.height = camera.height;
  bytes.point_step = 16;
  bytes.row_step = 16 * camera.width;
  bytes.fields = kFields;
  bytes.field_count = 3;
  bytes.data = reinterpret_cast<const std::uint8_t*>(cloud.data());
  bytes.size = cloud.size() * sizeof(float);
  return *CloudView::open(bytes);
}

FloorParameters parametersFor(FloorMethod method, bool calibrating) {
  FloorParameters parameters;
  parameters.method = method;
  parameters.calibrate_mounting = calibrating;
  return parameters;
}

/// How well the segmenter found its mounting, where it did.
std::optional<MountingFault> faultOf(const MountingEstimate& found, const sim::Mounting& truth) {
  if (!found.valid) return std::nullopt;
  const double angle =
      std::max(std::abs(found.pitch - truth.pitch), std::abs(found.roll - truth.roll));
  return MountingFault{angle / kDegree, std::abs(found.height - truth.height)};
}

Share agreement(const std::vector<CellClass>& a, const std::vector<CellClass>& b) {
  Share share;
  for (std::size_t i = 0; i < a.size(); ++i) share.count(a[i] == b[i]);
  return share;
}

std::vector<float> metresOf(const std::vector<std::uint16_t>& image) {
  std::vector<float> metres(image.size());
  std::transform(image.begin(), image.end(), metres.begin(),
                 [](std::uint16_t mm) { return static_cast<float>(mm) * 0.001F; });
  return metres;
}

}  // namespace

FloorResult runTrial(const FloorTask& task, std::uint64_t seed, bool keep_pictures) {
  using sim::mixSeed;
  const std::uint64_t own = mixSeed(mixSeed(mixSeed(seed, static_cast<std::uint64_t>(task.run)),
                                            static_cast<std::uint64_t>(task.kind)),
                                    task.calibrating ? 1 : 0);
  const sim::CameraModel camera;
  const sim::FloorScene scene = sim::randomScene(task.kind, mixSeed(own, 0));
  const sim::Mounting truth_mounting = trueMounting(task, mixSeed(own, 1));
  sim::PerfectView perfect;
  sim::render(scene, camera, truth_mounting.T_base_optical(), perfect);

  FloorSegmenter original(parametersFor(FloorMethod::kOriginal, task.calibrating));
  FloorSegmenter improved(parametersFor(FloorMethod::kImproved, task.calibrating));
  const Eigen::Isometry3f T_configured = kConfigured.T_base_optical().cast<float>();
  sim::Random random(mixSeed(own, 2));
  const sim::DepthNoise noise;
  std::vector<std::uint16_t> image;
  FloorCells original_grid, improved_grid;
  const int frames = task.calibrating ? kCalibrationFrames : 1;
  for (int frame = 0; frame < frames; ++frame) {
    sim::measure(perfect.depths, noise, random, image);
    original_grid = original.segment(viewOf(image, camera), T_configured);
    improved_grid = improved.segment(viewOf(image, camera), T_configured);
  }

  FloorResult result;
  result.task = task;
  const FloorParameters& parameters = improved.parameters();
  CellRule rule;
  rule.geometry = improved_grid.geometry;
  rule.clear_height = parameters.clear_height;
  rule.min_points = static_cast<std::uint32_t>(parameters.min_points);
  // A method that is not told of the mount error is judged in the frame that it is given; one that
  // corrects it, in the true frame.
  const Eigen::Isometry3d T_judged =
      task.calibrating ? truth_mounting.T_base_optical() : kConfigured.T_base_optical();
  std::vector<SurfaceCounts> counts;
  countSurfaces(perfect.depths, perfect.surfaces, camera, T_judged, rule, counts);
  SceneTruth truth{truthOf(counts, rule, scene.edge), {}, task.kind == sim::SceneKind::kEmpty};
  countSurfaces(metresOf(image), perfect.surfaces, camera, T_judged, rule, counts);
  truth.measured = measuredIn(counts, rule);
  const std::vector<CellClass> ceiling_classes = ceilingOf(counts, rule);
  result.ceiling = score(truth, ceiling_classes, rule.geometry);
  result.original = score(truth, original_grid.classes, rule.geometry);
  result.improved = score(truth, improved_grid.classes, rule.geometry);
  if (task.calibrating) {
    result.mounting = faultOf(improved.mounting(), truth_mounting);
  } else {
    const std::vector<float> cloud = cloudOf(image, camera);
    result.doors_agree = agreement(improved_grid.classes,
                                   improved.segment(viewOf(cloud, camera), T_configured).classes);
  }
  if (keep_pictures) {
    result.image = image;
    result.image_width = camera.width;
    result.image_height = camera.height;
    result.ceiling_classes = ceiling_classes;
    result.truth = truth.cells;
    result.original_classes = original_grid.classes;
    result.improved_classes = improved_grid.classes;
  }
  result.geometry = rule.geometry;
  return result;
}

}  // namespace pilothouse::bench
