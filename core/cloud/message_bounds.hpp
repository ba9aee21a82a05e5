#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace pilothouse {

/// Largest lengths that a serialised message may claim.
struct MessageBounds {
  std::size_t max_text = 1024;                  ///< bytes of a frame, encoding or field name
  std::size_t max_fields = 64;                  ///< entries of a PointCloud2's field list
  std::size_t max_data = std::size_t{1} << 28;  ///< bytes of pixels or points
  std::size_t max_coefficients = 64;            ///< distortion coefficients of a CameraInfo
  std::size_t max_cells = 1000000;              ///< entries of each of a FloorGrid's arrays
  std::size_t max_objects = 1000000;            ///< entries of an ObjectList
  std::size_t max_sources = 64;                 ///< sources that an ObjectList names
  std::size_t max_poses = 100000;               ///< poses of a Path
};

/// A length in a serialised message that does not fit its bytes or its bounds.
struct LengthFault {
  const char* thing;    ///< what the length belongs to
  std::uint64_t value;  ///< as claimed
  std::uint64_t limit;  ///< largest that would have been accepted here
};

/// "length of PointCloud2 fields is 40000000, expected 0 to 64".
std::string describe(const LengthFault& fault);

/// Walk the length prefixes of a message in the ROS 1 wire format (little endian, a uint32 before
/// every text and array) and return the first that does not fit the bytes or the bounds; nothing
/// when the message may be deserialised. Neither allocates nor reads outside [bytes, bytes + size).
/// They exist because deserialisers allocate what a prefix claims before they look whether it can
/// be true: 64 bytes that claim 40 million fields cost roscpp 1.8 GB. Sizes that contradict each
/// other (width, steps, data; a grid's cells) are the business of who reads the message.
std::optional<LengthFault> pointCloud2Fault(const std::uint8_t* bytes, std::size_t size,
                                            const MessageBounds& bounds = {});
std::optional<LengthFault> imageFault(const std::uint8_t* bytes, std::size_t size,
                                      const MessageBounds& bounds = {});
std::optional<LengthFault> compressedImageFault(const std::uint8_t* bytes, std::size_t size,
                                                const MessageBounds& bounds = {});
std::optional<LengthFault> cameraInfoFault(const std::uint8_t* bytes, std::size_t size,
                                           const MessageBounds& bounds = {});
std::optional<LengthFault> floorGridFault(const std::uint8_t* bytes, std::size_t size,
                                          const MessageBounds& bounds = {});
std::optional<LengthFault> objectListFault(const std::uint8_t* bytes, std::size_t size,
                                           const MessageBounds& bounds = {});
std::optional<LengthFault> pathFault(const std::uint8_t* bytes, std::size_t size,
                                     const MessageBounds& bounds = {});

}  // namespace pilothouse
