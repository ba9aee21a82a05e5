#include "nodelets/map_keeper.hpp"

#include <filesystem>
#include <stdexcept>

#include "doors/map_files.hpp"

namespace pilothouse {
namespace {

using Lock = std::lock_guard<std::mutex>;

std::string textOf(const char* fault) {
  return fault == nullptr ? "" : fault;
}

}  // namespace

MapKeeper::MapKeeper(const MapKeeperSettings& settings)
    : settings_(settings),
      map_(std::make_shared<OccupancyMap>(settings.occupancy)),
      statics_(settings.statics),
      kept_(settings.name) {
  if (settings_.name.empty()) return;
  const std::string base = settings_.folder + "/" + settings_.name;
  if (!std::filesystem::exists(base + ".phmap") && !std::filesystem::exists(base + ".yaml")) return;
  try {
    load(settings_.name);
  } catch (const std::runtime_error& fault) {
    kept_.isBad(fault.what());
  }
}

std::string MapKeeper::floor(const FloorFrame& frame, const Pose2& pose) {
  const Lock lock(mutex_);
  const char* fault = map_->addFloor(frame, pose);
  if (fault != nullptr) return fault;
  pose_ = pose;
  statics_.look(frame, pose, *map_);
  return {};
}

std::string MapKeeper::objects(const std::vector<Obstacle>& objects, const Pose2& pose,
                               double stamp) {
  const Lock lock(mutex_);
  statics_.see(objects, pose, stamp, *map_);
  return {};
}

std::string MapKeeper::scan(const PlanarScan& scan, const Pose2& pose) {
  const Lock lock(mutex_);
  return textOf(map_->addScan(scan, pose));
}

void MapKeeper::setSight(const CameraSight& sight) {
  const Lock lock(mutex_);
  statics_.setSight(sight);
}

void MapKeeper::timeJumped() {
  const Lock lock(mutex_);
  statics_.clear();
}

std::string MapKeeper::save(const std::string& name) {
  const std::string chosen = kept_.chosen(name);
  const Lock files_lock(files_);
  std::optional<OccupancyMap> map;
  std::uint32_t version = 0;
  {
    const Lock lock(mutex_);
    map = map_->copy();
    version = version_ + map_->version();
  }
  saveMap(settings_.folder, chosen, filesOf(*map));
  const Lock lock(mutex_);
  kept_.saved(chosen, version);
  return "saved " + settings_.folder + "/" + chosen;
}

void MapKeeper::saveByItself() {
  {
    const Lock lock(mutex_);
    if (!kept_.isBehind(version_ + map_->version(), map_->blockCount() == 0)) return;
  }
  try {
    save(settings_.name);
  } catch (const std::runtime_error& fault) {
    const Lock lock(mutex_);
    kept_.failed(fault.what());
  }
}

void MapKeeper::use(const std::shared_ptr<OccupancyMap>& map) {
  version_ += map_->version() + 1;  // never one that somebody has seen
  map_ = map;
  statics_.clear();
}

std::string MapKeeper::load(const std::string& name) {
  const std::string chosen = kept_.chosen(name);
  const auto map = loadMap(settings_.folder, chosen, settings_.occupancy);
  if (!map) throw std::runtime_error(map.reason());
  const Lock lock(mutex_);
  use(*map);
  kept_.loaded(chosen, version_ + map_->version());
  return "loaded " + settings_.folder + "/" + chosen;
}

void MapKeeper::clear() {
  const Lock lock(mutex_);
  use(std::make_shared<OccupancyMap>(settings_.occupancy));
}

bool MapKeeper::look(View& view) const {
  const Lock lock(mutex_);
  const std::uint32_t version = version_ + map_->version();
  if (view.version == version && !view.cells.cells.empty()) return false;
  view.version = version;
  map_->snapshot(view.cells);
  if (view.cells.cells.empty()) {  // nothing is known yet: say so, with a cell
    view.cells.size_x = view.cells.size_y = 1;
    view.cells.cells.assign(1, MapCell::kUnknown);
  }
  view.standing.clear();
  statics_.collect(pose_, *map_, view.standing);
  return true;
}

MapKeeper::Report MapKeeper::report() const {
  const Lock lock(mutex_);
  return {map_->blockCount(), map_->refusedCells(), statics_.entered(), statics_.cleared(),
          kept_.fault()};
}

}  // namespace pilothouse
