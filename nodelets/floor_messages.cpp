#include "nodelets/floor_messages.hpp"

#include <boost/make_shared.hpp>

namespace pilothouse {

FloorGrid::Ptr toMessage(const std_msgs::Header& header, const FloorCells& grid,
                         FloorMethod method) {
  auto message = boost::make_shared<FloorGrid>();
  const GridGeometry& g = grid.geometry;
  message->header = header;
  message->info.map_load_time = header.stamp;
  message->info.resolution = g.cell_size;
  message->info.width = static_cast<std::uint32_t>(g.size_x);
  message->info.height = static_cast<std::uint32_t>(g.size_y);
  message->info.origin.position.x = g.x_min;
  message->info.origin.position.y = g.y_min;
  message->info.origin.orientation.w = 1.0;
  message->classes.resize(grid.classes.size());
  for (std::size_t i = 0; i < grid.classes.size(); ++i) {
    message->classes[i] = static_cast<std::uint8_t>(grid.classes[i]);
  }
  message->heights = grid.heights;
  message->deviations = grid.deviations;
  message->method = method == FloorMethod::kOriginal ? "original" : "improved";
  return message;
}

ObjectList::Ptr toMessage(const std_msgs::Header& header, const FloorCells& grid,
                          const std::vector<GridObject>& objects) {
  auto message = boost::make_shared<ObjectList>();
  const GridGeometry& g = grid.geometry;
  message->header = header;
  message->source = "camera";
  message->objects.resize(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const GridObject& found = objects[i];
    Object& object = message->objects[i];
    object.position.x = g.centreX(found.ix);
    object.position.y = g.centreY(found.iy);
    object.position.z = grid.heights[g.index(found.ix, found.iy)];
    object.size = g.cell_size;
    object.kind = static_cast<std::uint8_t>(found.kind);
    object.nearest_in_row = found.nearest_in_row;
  }
  return message;
}

sensor_msgs::LaserScan::Ptr toMessage(const std_msgs::Header& header, const ScanGeometry& scan,
                                      const std::vector<float>& ranges) {
  auto message = boost::make_shared<sensor_msgs::LaserScan>();
  message->header = header;
  message->angle_min = scan.angle_min;
  message->angle_increment = scan.increment;
  message->angle_max = scan.angle_min + scan.increment * static_cast<float>(scan.beams - 1);
  message->range_min = 0.0F;
  message->range_max = scan.range_max;
  message->ranges = ranges;
  return message;
}

sensor_msgs::PointCloud2::Ptr toMessage(const std_msgs::Header& camera,
                                        std::vector<std::uint8_t>&& xyz) {
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header = camera;
  message->fields.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    message->fields[i].name = std::string(1, "xyz"[i]);
    message->fields[i].offset = 4 * i;
    message->fields[i].datatype = sensor_msgs::PointField::FLOAT32;
    message->fields[i].count = 1;
  }
  message->point_step = 12;
  message->height = 1;
  message->width = static_cast<std::uint32_t>(xyz.size() / message->point_step);
  message->row_step = message->width * message->point_step;
  message->is_dense = true;
  message->data = std::move(xyz);
  return message;
}

}  // namespace pilothouse
