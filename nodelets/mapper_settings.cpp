#include "nodelets/mapper_settings.hpp"

#include "doors/map_files.hpp"
#include "doors/strict_parameters.hpp"
#include "nodelets/usual_folder.hpp"

namespace pilothouse {
MapperSettings readMapperSettings(const ros::NodeHandle& own) {
  MapperSettings settings;
  MapKeeperSettings& keeper = settings.keeper;
  keeper.folder = usualMapFolder();
  StrictParameters reader(own);
  reader.read("base_frame", settings.base_frame);
  reader.read("map_frame", settings.map_frame);
  reader.read("folder", keeper.folder);
  reader.read("map", keeper.name);
  reader.read("use_scan", settings.use_scan);
  reader.read("publish_rate", settings.publish_rate, 0.1, 30.0);
  reader.read("autosave", settings.autosave, 1.0, 3600.0);
  reader.read("echoes", keeper.statics.echoes);
  const auto read = [&reader](const char* key, auto& value, auto low, auto high) {
    reader.read(key, value, low, high);
  };
  forEachOccupancyParameter(keeper.occupancy, read);
  forEachStaticParameter(keeper.statics, read);
  if (!keeper.name.empty()) {
    const std::string fault = mapNameFault(keeper.name);
    if (!fault.empty()) reader.addFault("map: " + fault);
  }
  if (reader.faultCount() == 0) {
    for (const auto& fault : validate(keeper.occupancy)) reader.addFault(fault);
  }
  reader.finish();
  return settings;
}

}  // namespace pilothouse
