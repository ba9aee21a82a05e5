#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/cloud/checked.hpp"

namespace pilothouse {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

/// Largest PCD file that is read; what a reader allocates for one follows from these.
struct PcdBounds {
  std::uint64_t max_points = std::uint64_t{1} << 22;
  std::uint64_t max_bytes = std::uint64_t{1} << 28;  ///< of all points, uncompressed
  std::uint64_t max_file = std::uint64_t{1} << 30;   ///< bytes
  std::size_t max_fields = 64;
};

/// Bytes from the start of a file within which a header must end.
constexpr std::size_t kLargestPcdHeader = 8192;

/// What the header of a PCD file (format 0.7, pointclouds.org/documentation/tutorials/
/// pcd_file_format.html) says, once it is known to agree with the file's size.
struct PcdHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t point_step = 0;  ///< bytes a point, uncompressed
  PcdData data = PcdData::kAscii;
  std::size_t data_offset = 0;  ///< bytes from the start of the file
};

/// Reads the header and refuses, with the reason, every file that a reader would have to allocate
/// more for than the file holds: its points must be there, whatever their coding. Stricter than
/// most readers: the keys in the format's order, each once, none unknown; VERSION, COUNT and
/// VIEWPOINT may be missing; x y z as float32. Allocates nothing by what the file claims.
/// @param head the first bytes of the file, at least kLargestPcdHeader or all of it.
/// @param file_size bytes of the whole file.
Checked<PcdHeader> parsePcdHeader(std::string_view head, std::uint64_t file_size,
                                  const PcdBounds& bounds = {});

}  // namespace pilothouse
