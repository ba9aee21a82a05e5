#include "nodelets/map_messages.hpp"

#include <boost/make_shared.hpp>

namespace pilothouse {

nav_msgs::OccupancyGrid::Ptr toOccupancyGrid(const std_msgs::Header& header, const MapCells& map) {
  constexpr std::int8_t kValues[] = {-1, 0, 20, 100, 100};  // by MapCell
  auto message = boost::make_shared<nav_msgs::OccupancyGrid>();
  message->header = header;
  message->info.map_load_time = header.stamp;
  message->info.resolution = static_cast<float>(map.cell_size);
  message->info.width = static_cast<std::uint32_t>(map.size_x);
  message->info.height = static_cast<std::uint32_t>(map.size_y);
  message->info.origin.position.x = map.origin_x;
  message->info.origin.position.y = map.origin_y;
  message->info.origin.orientation.w = 1.0;
  message->data.resize(map.cells.size());
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    message->data[i] = kValues[static_cast<std::size_t>(map.cells[i])];
  }
  return message;
}

}  // namespace pilothouse
