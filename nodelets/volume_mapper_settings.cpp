#include "nodelets/volume_mapper_settings.hpp"

#include "doors/map_files.hpp"
#include "doors/strict_parameters.hpp"
#include "nodelets/usual_folder.hpp"

namespace pilothouse {

VolumeMapperSettings readVolumeMapperSettings(const ros::NodeHandle& own) {
  VolumeMapperSettings settings;
  VolumeKeeperSettings& keeper = settings.keeper;
  keeper.folder = usualMapFolder();
  StrictParameters reader(own);
  reader.read("map_frame", settings.map_frame);
  reader.read("folder", keeper.folder);
  reader.read("map", keeper.name);
  reader.read("rate", settings.rate, 0.1, 30.0);
  reader.read("publish_period", settings.publish_period, 0.2, 60.0);
  reader.read("autosave", settings.autosave, 1.0, 3600.0);
  reader.read("most_shown", settings.most_shown, 1, 1000000);
  forEachVolumeParameter(keeper.volume,
                         [&reader](const char* key, auto& value, auto low, auto high) {
                           reader.read(key, value, low, high);
                         });
  if (!keeper.name.empty()) {
    const std::string fault = mapNameFault(keeper.name);
    if (!fault.empty()) reader.addFault("map: " + fault);
  }
  if (reader.faultCount() == 0) {
    for (const auto& fault : validate(keeper.volume)) reader.addFault(fault);
  }
  reader.finish();
  return settings;
}

}  // namespace pilothouse
