#pragma once

#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_parameters.hpp"

namespace pilothouse {

/// The original method: a known cell whose deviation of heights is above obstacle_deviation is an
/// obstacle, every other known cell is floor. Knows neither thresholds nor drop-offs.
/// Source: KTU master thesis on obstacle avoidance with a Kinect, 2014.
/// @param grid with statistics filled in; its classes are overwritten.
void judgeOriginal(const FloorParameters& parameters, FloorCells& grid);

}  // namespace pilothouse
