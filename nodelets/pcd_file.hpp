#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <string>

namespace pilothouse {

/// The cloud of a PCD file, organised or not, of any coding; its header is empty.
/// @throws std::runtime_error with the reason when the file is refused; PCL sees only files whose
/// header and size agree within PcdBounds.
sensor_msgs::PointCloud2 readPcd(const std::string& path);

}  // namespace pilothouse
