#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/binner.hpp"
#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/floor/mounting_calibrator.hpp"

namespace pilothouse {

/// Judges the floor, a frame at a time. Reuses its memory: no allocation after the first frame.
class FloorSegmenter {
 public:
  /// @throws std::invalid_argument listing every fault of the parameters.
  explicit FloorSegmenter(const FloorParameters& parameters);
  ~FloorSegmenter();
  FloorSegmenter(const FloorSegmenter&) = delete;
  FloorSegmenter& operator=(const FloorSegmenter&) = delete;

  /// @throws std::invalid_argument as the constructor; then the old parameters stay.
  void setParameters(const FloorParameters& parameters);
  const FloorParameters& parameters() const;
  /// For comparisons; the fastest supported one is used otherwise.
  void useKernel(BinningKernel kernel);

  /// @param T_base_camera takes points from the cloud's frame into the base frame; finite. The
  ///   frame is an optical one (x right, y down, z forward), as camera drivers publish clouds.
  /// @return the grid, valid until the next call.
  const FloorCells& segment(const CloudView& cloud, const Eigen::Isometry3f& T_base_camera);
  /// @param T_base_optical from the optical frame (x right, y down, z forward).
  const FloorCells& segment(const DepthView& depth, const Eigen::Isometry3f& T_base_optical);

  /// What the floor says of the mounting; learnt from every frame, used when the parameter
  /// calibrate_mounting is set.
  const MountingEstimate& mounting() const;
  /// The transform that the last grid was made with.
  const Eigen::Isometry3f& mountingUsed() const;
  /// Forgets what earlier frames taught, e.g. when time jumps.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pilothouse
