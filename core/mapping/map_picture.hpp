#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/cloud/checked.hpp"
#include "core/mapping/map_cells.hpp"
#include "core/mapping/occupancy_map.hpp"

namespace pilothouse {

// A map as map_server has it: a grey picture and a few words about it (wiki.ros.org/map_server).
// What is free is white, what is occupied black, and thresholds and drop-offs are lost.

/// A binary PGM (P5, netpbm.sourceforge.net/doc/pgm.html) of 8 bits; borrows the file's bytes.
struct GreyPicture {
  std::uint32_t width = 0, height = 0;   ///< 1..20000
  std::uint32_t white = 255;             ///< greatest value, 1..255
  const std::uint8_t* pixels = nullptr;  ///< width * height, row by row from the top
};
/// Refused where the header is not that of a P5, or the file's size does not fit it.
Checked<GreyPicture> parsePgm(std::string_view bytes);

/// What map_server's YAML says of its picture.
struct PictureMeaning {
  double resolution = 0.05;               ///< edge of a pixel [m], 0.01..0.5
  double origin_x = 0.0, origin_y = 0.0;  ///< lower left corner of the picture [m]
  bool negate = false;                    ///< white is occupied
  double occupied_thresh = 0.65;          ///< darker than this is occupied, 0..1
  double free_thresh = 0.196;             ///< lighter is free, 0..occupied_thresh
};

/// Refused where a number is out of its range or the picture reaches out of the parameters' square.
/// Cells of 205 (what map_server writes for unknown) are unknown by the usual limits.
Checked<std::shared_ptr<OccupancyMap>> mapOf(const GreyPicture& picture,
                                             const PictureMeaning& meaning,
                                             const OccupancyParameters& parameters);

/// The picture as map_saver writes it: 254 free, 205 unknown, 0 occupied.
std::string encodePgm(const MapCells& map);

}  // namespace pilothouse
