#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/mapping/map_cells.hpp"
#include "core/mapping/occupancy_map.hpp"
#include "core/mapping/static_objects.hpp"
#include "nodelets/kept_file.hpp"

namespace pilothouse {

struct MapKeeperSettings {
  OccupancyParameters occupancy;
  StaticParameters statics;
  std::string folder;  ///< of all maps
  std::string name;    ///< of the map that is loaded at the start and saved by itself; empty: none
};

/// The map in use with its files. Any thread may call any function: none of them waits for a disk
/// while it keeps the map from learning.
class MapKeeper {
 public:
  /// Loads the map of the settings, where there is one. A bad one is told by fault(), and is not
  /// written over until a map was saved or loaded by hand.
  explicit MapKeeper(const MapKeeperSettings& settings);

  // Each returns why it was refused; empty: it was not.
  std::string floor(const FloorFrame& frame, const Pose2& T_map_base);
  std::string objects(const std::vector<Obstacle>& objects, const Pose2& T_map_base, double stamp);
  std::string scan(const PlanarScan& scan, const Pose2& T_map_base);
  void setSight(const CameraSight& sight);
  /// The map stays; what was about to enter it is forgotten.
  void timeJumped();

  /// @param name empty: that of the settings. @return what was done.
  /// @throws std::runtime_error with the reason; then files or map are as they were.
  std::string save(const std::string& name);
  std::string load(const std::string& name);
  void clear();
  /// Saves the map of the settings where it has changed since it was saved.
  void saveByItself();

  struct View {
    std::uint32_t version = 0;
    MapCells cells;
    std::vector<Obstacle> standing;  ///< round the robot, map frame
  };
  /// @return false where `view` is of this version already.
  bool look(View& view) const;

  struct Report {
    std::size_t blocks = 0;
    std::uint64_t refused_cells = 0, entered = 0, cleared = 0;
    std::string fault;  ///< of the files; empty: none
  };
  Report report() const;

 private:
  void use(const std::shared_ptr<OccupancyMap>& map);

  MapKeeperSettings settings_;
  mutable std::mutex mutex_;  ///< guards the map and all that goes with it
  std::mutex files_;          ///< one writer at a time; taken before the other
  std::shared_ptr<OccupancyMap> map_;
  StaticObjects statics_;
  Pose2 pose_;
  std::uint32_t version_ = 0;  ///< of the maps that came before this one
  KeptFile kept_;
};

}  // namespace pilothouse
