#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_grid.hpp"
#include "core/floor/floor_parameters.hpp"

namespace pilothouse {

/// Judges the floor, a frame at a time. Reuses its memory: no allocation after the first frame.
class FloorSegmenter {
 public:
  /// @throws std::invalid_argument listing every fault of the parameters.
  explicit FloorSegmenter(const FloorParameters& parameters);
  ~FloorSegmenter();
  FloorSegmenter(const FloorSegmenter&) = delete;
  FloorSegmenter& operator=(const FloorSegmenter&) = delete;

  void setParameters(const FloorParameters& parameters);
  const FloorParameters& parameters() const;

  /// @param T_base_camera takes points from the cloud's frame into the base frame; finite.
  /// @return the grid, valid until the next call.
  const FloorGrid& segment(const CloudView& cloud, const Eigen::Isometry3f& T_base_camera);
  /// @param T_base_optical from the optical frame (x right, y down, z forward).
  const FloorGrid& segment(const DepthView& depth, const Eigen::Isometry3f& T_base_optical);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pilothouse
