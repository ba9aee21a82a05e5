#pragma once

#include <memory>
#include <string>

#include "core/cloud/checked.hpp"
#include "core/mapping/occupancy_map.hpp"

namespace pilothouse {

// A map in a folder, under a name: NAME.phmap is our own form (core/mapping/map_bytes.hpp),
// NAME.yaml with NAME.*.pgm is map_server's. Each is replaced at once or not at all.

/// Why this is no name for a map; empty: it is one.
std::string mapNameFault(const std::string& name);

/// A map as its files' bytes, so that it can go on learning while they are written.
struct MapFiles {
  std::string own;                                          ///< of NAME.phmap
  std::string picture;                                      ///< of NAME.*.pgm
  double resolution = 0.0, origin_x = 0.0, origin_y = 0.0;  ///< of NAME.yaml [m]
};
MapFiles filesOf(const OccupancyMap& map);

/// @throws std::runtime_error with the reason; then what was there before is whole.
void saveMap(const std::string& folder, const std::string& name, const MapFiles& files);

/// Our own form where it is there, else map_server's. The reason begins with the file's name.
/// @param parameters of the map that is made, all but its cell size, which is the file's.
Checked<std::shared_ptr<OccupancyMap>> loadMap(const std::string& folder, const std::string& name,
                                               const OccupancyParameters& parameters);

/// A map_server YAML and its picture, which lies in the same folder.
Checked<std::shared_ptr<OccupancyMap>> loadMapServer(const std::string& yaml_path,
                                                     const OccupancyParameters& parameters);

}  // namespace pilothouse
