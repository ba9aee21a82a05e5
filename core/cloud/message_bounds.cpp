#include "core/cloud/message_bounds.hpp"

#include "core/cloud/wire_walk.hpp"

namespace pilothouse {
std::string describe(const LengthFault& fault) {
  return std::string("length of ") + fault.thing + " is " + std::to_string(fault.value) +
         ", expected 0 to " + std::to_string(fault.limit);
}

std::optional<LengthFault> pointCloud2Fault(const std::uint8_t* bytes, std::size_t size,
                                            const MessageBounds& bounds) {
  constexpr std::uint64_t kLeastField = 4 + 4 + 1 + 4;  // empty name, offset, datatype, count
  WireWalk walk(bytes, size);
  walk.header(bounds);
  walk.skip(8, "height and width");
  const std::uint32_t fields = walk.count("PointCloud2 fields", bounds.max_fields, kLeastField);
  for (std::uint32_t i = 0; i < fields; ++i) {
    walk.array("PointCloud2 field name", bounds.max_text, 1);
    walk.skip(9, "PointCloud2 field");
  }
  walk.skip(9, "PointCloud2 steps");  // is_bigendian, point_step, row_step
  walk.array("PointCloud2 data", bounds.max_data, 1);
  walk.skip(1, "is_dense");
  return walk.end();
}

std::optional<LengthFault> imageFault(const std::uint8_t* bytes, std::size_t size,
                                      const MessageBounds& bounds) {
  WireWalk walk(bytes, size);
  walk.header(bounds);
  walk.skip(8, "height and width");
  walk.array("Image encoding", bounds.max_text, 1);
  walk.skip(5, "Image step");  // is_bigendian, step
  walk.array("Image data", bounds.max_data, 1);
  return walk.end();
}

std::optional<LengthFault> compressedImageFault(const std::uint8_t* bytes, std::size_t size,
                                                const MessageBounds& bounds) {
  WireWalk walk(bytes, size);
  walk.header(bounds);
  walk.array("CompressedImage format", bounds.max_text, 1);
  walk.array("CompressedImage data", bounds.max_data, 1);
  return walk.end();
}

std::optional<LengthFault> cameraInfoFault(const std::uint8_t* bytes, std::size_t size,
                                           const MessageBounds& bounds) {
  constexpr std::uint64_t kMatrices = (9 + 9 + 12) * 8;  // K, R, P
  constexpr std::uint64_t kBinningAndRoi = 2 * 4 + 4 * 4 + 1;
  WireWalk walk(bytes, size);
  walk.header(bounds);
  walk.skip(8, "height and width");
  walk.array("CameraInfo distortion_model", bounds.max_text, 1);
  walk.array("CameraInfo D", bounds.max_coefficients, 8);
  walk.skip(kMatrices + kBinningAndRoi, "CameraInfo matrices");
  return walk.end();
}

std::optional<LengthFault> floorGridFault(const std::uint8_t* bytes, std::size_t size,
                                          const MessageBounds& bounds) {
  constexpr std::uint64_t kPose = 7 * 8;
  WireWalk walk(bytes, size);
  walk.header(bounds);
  walk.skip(8 + 4 + 4 + 4 + kPose, "FloorGrid info");  // map_load_time, resolution, width, height
  walk.array("FloorGrid classes", bounds.max_cells, 1);
  walk.array("FloorGrid heights", bounds.max_cells, 4);
  walk.array("FloorGrid deviations", bounds.max_cells, 4);
  walk.array("FloorGrid method", bounds.max_text, 1);
  return walk.end();
}

std::optional<LengthFault> objectListFault(const std::uint8_t* bytes, std::size_t size,
                                           const MessageBounds& bounds) {
  constexpr std::uint64_t kObject = 3 * 4 + 4 + 5;   // position, size, five bytes
  constexpr std::uint64_t kLeastSource = 4 + 8 + 4;  // empty name, stamp, age
  WireWalk walk(bytes, size);
  walk.header(bounds);
  walk.array("ObjectList source", bounds.max_text, 1);
  const std::uint32_t sources = walk.count("ObjectList sources", bounds.max_sources, kLeastSource);
  for (std::uint32_t i = 0; i < sources; ++i) {
    walk.array("ObjectList source name", bounds.max_text, 1);
    walk.skip(12, "ObjectList source");
  }
  walk.array("ObjectList objects", bounds.max_objects, kObject);
  return walk.end();
}

std::optional<LengthFault> pathFault(const std::uint8_t* bytes, std::size_t size,
                                     const MessageBounds& bounds) {
  constexpr std::uint64_t kPose = 7 * 8;
  constexpr std::uint64_t kLeastHeader = 4 + 8 + 4;  // empty frame
  WireWalk walk(bytes, size);
  walk.header(bounds);
  const std::uint32_t poses = walk.count("Path poses", bounds.max_poses, kLeastHeader + kPose);
  for (std::uint32_t i = 0; i < poses; ++i) {
    walk.header(bounds);
    walk.skip(kPose, "Path pose");
  }
  return walk.end();
}

}  // namespace pilothouse
