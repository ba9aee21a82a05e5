#include "nodelets/map_services.hpp"

#include <nav_msgs/GetMap.h>

#include "nodelets/file_service.hpp"
#include "nodelets/map_messages.hpp"

namespace pilothouse {

MapServices::MapServices(const ros::NodeHandle& handle, MapKeeper& keeper,
                         const std::string& map_frame)
    : services_(handle) {
  ros::NodeHandle& own = services_.handle();
  services_.keep(
      offerFile(own, "map/save", [&keeper](const std::string& name) { return keeper.save(name); }));
  services_.keep(
      offerFile(own, "map/load", [&keeper](const std::string& name) { return keeper.load(name); }));
  services_.keep(offerTrigger(own, "map/clear", [&keeper] {
    keeper.clear();
    return std::string("the map is empty; its files are as they were");
  }));
  using GetMap = nav_msgs::GetMap;
  services_.keep(own.advertiseService<GetMap::Request, GetMap::Response>(
      "static_map", [&keeper, map_frame](GetMap::Request&, GetMap::Response& response) {
        MapKeeper::View view;
        keeper.look(view);
        std_msgs::Header header;
        header.stamp = ros::Time::now();
        header.frame_id = map_frame;
        response.map = *toOccupancyGrid(header, view.cells);
        return true;
      }));
}

}  // namespace pilothouse
