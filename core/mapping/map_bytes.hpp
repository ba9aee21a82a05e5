#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "core/cloud/checked.hpp"
#include "core/mapping/occupancy_map.hpp"

namespace pilothouse {

// Our own form of a map, in which nothing of it is lost: little endian,
//   0  8 bytes  "PHMAP\r\n\x1A"
//   8  uint32   version, 1
//  12  uint32   bytes of this header, 64
//  16  double   cell size [m]; 24, 32: lower left corner of cell (0, 0) [m]
//  40  uint32   cells a side of a block, 16; 44: blocks
//  48  uint64   bytes of the whole
//  56  uint32   CRC-32 of all after the header; 60: of the header before here
// and a block each, row by row: int32 column, int32 row, then for its 256 cells, row by row, int16
// log-odds in 0.01, int8 threshold, int8 drop-off (MapCellState).

constexpr std::size_t kMapHeaderBytes = 64;
constexpr std::size_t kMapBlockBytes = 8 + 4 * 16 * 16;

std::string encodeMap(const OccupancyMap& map);

/// @param parameters of the map that is made, all but its cell size, which is the file's.
/// @return refused where anything is not as said above, lies outside of the parameters' square, or
/// the checksums do not fit; the reason names the thing, its value and what was expected.
Checked<std::shared_ptr<OccupancyMap>> decodeMap(std::string_view bytes,
                                                 const OccupancyParameters& parameters);

}  // namespace pilothouse
