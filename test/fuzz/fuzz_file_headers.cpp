// What the header checks let pass must be in the file; what they refuse has a reason. The first
// byte of the input chooses PCD or PNG.
#include "core/replay/pcd_header.hpp"
#include "core/replay/png_header.hpp"
#include "test/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const bool pcd = (input.take<std::uint8_t>() & 1U) == 0;
  const auto bytes = input.rest();
  const std::size_t left = input.left();
  if (!pcd) {
    const auto header = parsePngHeader(bytes.data(), left);
    if (!header) return require(!header.reason().empty()), 0;
    require(header->width > 0 && header->width <= 8192);
    require(header->height > 0 && header->height <= 8192);
    return 0;
  }
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), left);
  const auto header = parsePcdHeader(head, left);
  if (!header) return require(!header.reason().empty()), 0;
  const std::size_t points = std::size_t{header->width} * header->height;
  require(points > 0 && header->point_step >= 12 && header->data_offset <= left);
  if (header->data == PcdData::kBinary)
    require(header->data_offset + points * header->point_step <= left);
  if (header->data == PcdData::kAscii) require(points * 6 <= left - header->data_offset + 1);
  return 0;
}
