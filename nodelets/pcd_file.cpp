// The only file that includes PCL's reader: it is slow to compile.
#include "nodelets/pcd_file.hpp"

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>
#include <pcl_conversions/pcl_conversions.h>

#include <stdexcept>

#include "core/replay/pcd_header.hpp"
#include "doors/file_bytes.hpp"
#include "doors/message_views.hpp"

namespace pilothouse {

sensor_msgs::PointCloud2 readPcd(const std::string& path) {
  const std::uint64_t size = fileSize(path);
  const auto header = parsePcdHeader(readHead(path, kLargestPcdHeader + 8), size);
  if (!header) throw std::runtime_error(header.reason());

  pcl::PCLPointCloud2 read;
  pcl::PCDReader reader;
  if (reader.read(path, read) < 0) throw std::runtime_error("PCD data is damaged, expected points");
  sensor_msgs::PointCloud2 cloud;
  pcl_conversions::moveFromPCL(read, cloud);
  cloud.header = std_msgs::Header();
  const auto view = openView(cloud);
  if (!view) throw std::runtime_error(view.reason());
  if (view->width() != header->width || view->height() != header->height)
    throw std::runtime_error("PCD data holds " + std::to_string(view->width()) + " x " +
                             std::to_string(view->height()) + " points, expected " +
                             std::to_string(header->width) + " x " +
                             std::to_string(header->height));
  return cloud;
}

}  // namespace pilothouse
