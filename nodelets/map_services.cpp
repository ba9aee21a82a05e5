#include "nodelets/map_services.hpp"

#include <nav_msgs/GetMap.h>
#include <pilothouse/MapFile.h>
#include <std_srvs/Trigger.h>

#include <stdexcept>

#include "nodelets/map_messages.hpp"

namespace pilothouse {
namespace {

template <class Response, class Work>
bool answer(Response& response, Work work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::runtime_error& fault) {
    response.message = fault.what();
  }
  return true;
}

}  // namespace

MapServices::MapServices(ros::NodeHandle& handle, MapKeeper& keeper, const std::string& map_frame) {
  services_.push_back(handle.advertiseService<MapFile::Request, MapFile::Response>(
      "map/save", [&keeper](MapFile::Request& request, MapFile::Response& response) {
        return answer(response, [&] { return keeper.save(request.name); });
      }));
  services_.push_back(handle.advertiseService<MapFile::Request, MapFile::Response>(
      "map/load", [&keeper](MapFile::Request& request, MapFile::Response& response) {
        return answer(response, [&] { return keeper.load(request.name); });
      }));
  using Trigger = std_srvs::Trigger;
  services_.push_back(handle.advertiseService<Trigger::Request, Trigger::Response>(
      "map/clear", [&keeper](Trigger::Request&, Trigger::Response& response) {
        keeper.clear();
        return answer(response,
                      [] { return std::string("the map is empty; its files are as they were"); });
      }));
  using GetMap = nav_msgs::GetMap;
  services_.push_back(handle.advertiseService<GetMap::Request, GetMap::Response>(
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
