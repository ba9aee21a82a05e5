#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include "core/cloud/checked.hpp"
#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"

namespace pilothouse {

/// Checked views over messages as received; valid as long as the message is.
Checked<CloudView> openView(const sensor_msgs::PointCloud2& cloud);

/// Takes the intrinsics of the rectified image (P); where the driver left P empty, K.
Checked<DepthView> openView(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info);

}  // namespace pilothouse
