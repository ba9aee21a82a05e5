// The whole way from untrusted bytes to the judged floor: whatever the doors open, both methods
// take without a step beyond the bytes, and every kernel judges as the reference does. The first
// bytes of the input choose the door, the method and the mounting.
#include <cmath>

#include "core/floor/floor_segmenter.hpp"
#include "core/floor/plane_search.hpp"
#include "core/floor/point_split.hpp"
#include "test/fuzz/cloud_input.hpp"
#include "test/fuzz/depth_input.hpp"

namespace pilothouse {
namespace {

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

void check(const FloorCells& grid) {
  const std::size_t cells = grid.geometry.cells();
  require(grid.classes.size() == cells && grid.heights.size() == cells &&
          grid.deviations.size() == cells && grid.counts.size() == cells);
  for (std::size_t i = 0; i < cells; ++i) {
    require(grid.classes[i] <= CellClass::kDropOff && !std::isinf(grid.heights[i]));
    require(grid.counts[i] > 0 || !isDrivable(grid.classes[i]));
  }
}

template <class View>
void judge(const View& view, const FloorParameters& parameters,
           const Eigen::Isometry3f& T_base_camera) {
  FloorSegmenter reference(parameters), fastest(parameters);
  reference.useKernel(BinningKernel::kReference);
  for (int frame = 0; frame < 2; ++frame) {  // the second meets the memory of the first
    const FloorCells& expected = reference.segment(view, T_base_camera);
    const FloorCells& grid = fastest.segment(view, T_base_camera);
    check(grid);
    require(grid.classes == expected.classes && grid.counts == expected.counts);
    require(same(grid.heights, expected.heights) && same(grid.deviations, expected.deviations));
  }
  std::vector<CellClass> classes;
  const FloorCells& grid = fastest.segment(view, T_base_camera);
  splitPoints(view, T_base_camera, grid, parameters, classes);
  require(classes.size() == std::size_t{view.width()} * view.height());
  PlaneSearchParameters search;
  search.hypotheses = 20;
  const auto plane = findFloorPlane(view, search);
  if (plane) require(plane->normal.allFinite() && std::isfinite(plane->height));
}

}  // namespace
}  // namespace pilothouse

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const auto choice = input.take<std::uint8_t>();
  const auto pitch = static_cast<float>(input.take<std::uint8_t>()) / 255.0F * 1.5F;
  FloorParameters parameters;
  parameters.cell_size = 0.1;
  parameters.range = 1.5;
  parameters.half_width = 0.5;
  parameters.min_points = 1;
  parameters.method = (choice & 1U) != 0 ? FloorMethod::kOriginal : FloorMethod::kImproved;
  parameters.calibrate_mounting = (choice & 2U) != 0;
  // Optical axes (x right, y down, z forward) in the base frame, looking down by `pitch`.
  Eigen::Matrix3f axes;
  axes << 0.0F, 0.0F, 1.0F, -1.0F, 0.0F, 0.0F, 0.0F, -1.0F, 0.0F;
  Eigen::Isometry3f T_base_camera = Eigen::Isometry3f::Identity();
  T_base_camera.linear() =
      Eigen::AngleAxisf(pitch, Eigen::Vector3f::UnitY()).toRotationMatrix() * axes;
  T_base_camera.translation() = Eigen::Vector3f(0.0F, 0.0F, 0.65F);
  if ((choice & 4U) != 0) {
    const CloudInput cloud(input);
    if (const auto view = CloudView::open(cloud.bytes)) judge(*view, parameters, T_base_camera);
  } else {
    const DepthInput depth(input);
    if (const auto view = DepthView::open(depth.bytes)) judge(*view, parameters, T_base_camera);
  }
  return 0;
}
