#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <memory>

#include <pilothouse/FloorGrid.h>
#include "core/cloud/checked.hpp"
#include "gui/model/depth_ramp.hpp"
#include "gui/model/pictures.hpp"
#include "pilothouse/ObjectList.h"

namespace pilothouse::gui {

template <class Picture>
using Converted = Checked<std::shared_ptr<const Picture>>;

/// Messages into pictures, on the conversion thread. Nothing in a message is trusted: whatever
/// cannot be read safely is refused with the reason.
class DepthConverter {
 public:
  /// @param info may be null: the picture is then without intrinsics.
  Converted<DepthPicture> fromImage(const sensor_msgs::Image& image,
                                    const sensor_msgs::CameraInfo* info);
  /// Needs an organised cloud (height above 1).
  Converted<DepthPicture> fromCloud(const sensor_msgs::PointCloud2& cloud);

 private:
  void paint(DepthPicture& picture, int width, int height);
  DepthRamp ramp_;
  DepthSpanChooser chooser_;
};

Converted<ColourPicture> colourFromImage(const sensor_msgs::Image& image);
/// JPEG or PNG; the size is read from the file's header and bounded before anything is decoded.
Converted<ColourPicture> colourFromCompressed(const sensor_msgs::CompressedImage& image);
/// Needs an organised cloud with a field rgb or rgba.
Converted<ColourPicture> colourFromCloud(const sensor_msgs::PointCloud2& cloud);

Converted<FloorPicture> floorFromMessage(const FloorGrid& grid);
Converted<ObjectsPicture> objectsFromMessage(const ObjectList& list);

/// Width and height in the header of a JPEG or PNG; refused when there is none.
struct CodedSize {
  int width, height;
};
Checked<CodedSize> codedSize(const std::vector<std::uint8_t>& bytes);

}  // namespace pilothouse::gui
