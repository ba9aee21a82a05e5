#pragma once

#include <QColor>
#include <cstddef>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "gui/model/depth_ramp.hpp"

namespace pilothouse::gui {

/// A space in cubes of one size, as it is drawn.
struct VolumeBoxes {
  float edge = 0.0F;                     ///< [m]
  std::vector<Eigen::Vector3f> middles;  ///< in the cloud's frame [m]
};

/// The voxels of a cloud; where there are more than `most`, in cubes of twice the edge, or four
/// times, that hold any of them: coarse, but without holes.
/// @param edge of the finest voxels [m], above 0; what is not finite or farther than 1 km is left
/// out.
VolumeBoxes boxesOf(const CloudView& cloud, float edge, std::size_t most);

/// Colour of a height [m]: dark on the floor, bright 1.2 m above it; the ramp of depth pictures.
QRgb colourOfHeight(const DepthRamp& ramp, float height);

}  // namespace pilothouse::gui
