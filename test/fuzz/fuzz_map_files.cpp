// A map's file is refused with a reason, or what it holds comes out as it went in. The first byte
// of the input: bit 0 chooses our own form or a PGM, bit 1 mends the checksums first, so that what
// lies behind them is reached.
#include <cstring>
#include <string>

#include "core/mapping/checksum.hpp"
#include "core/mapping/map_bytes.hpp"
#include "core/mapping/map_picture.hpp"
#include "test/fuzz/input.hpp"

namespace {

void put(std::string& bytes, std::size_t at, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i));
}

void mend(std::string& bytes) {
  using namespace pilothouse;
  if (bytes.size() < kMapHeaderBytes) return;
  put(bytes, 48, bytes.size(), 8);
  put(bytes, 44, (bytes.size() - kMapHeaderBytes) / kMapBlockBytes, 4);
  put(bytes, 56, crc32(std::string_view(bytes).substr(64)), 4);
  put(bytes, 60, crc32(std::string_view(bytes).substr(0, 60)), 4);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const auto choice = input.take<std::uint8_t>();
  OccupancyParameters parameters;
  parameters.max_side = 20.0;
  parameters.reach = 1.0;
  if ((choice & 1U) == 0) {
    const auto rest = input.rest();
    std::string bytes(reinterpret_cast<const char*>(rest.data()), input.left());
    if ((choice & 2U) != 0) mend(bytes);
    const auto map = decodeMap(bytes, parameters);
    if (!map) return require(!map.reason().empty()), 0;
    const std::string again = encodeMap(**map);
    const auto same = decodeMap(again, parameters);
    require(static_cast<bool>(same) && encodeMap(**same) == again);
    require(again.size() == bytes.size());
    return 0;
  }
  PictureMeaning meaning;
  meaning.resolution = input.take<double>();
  meaning.origin_x = input.take<double>();
  meaning.origin_y = input.take<double>();
  meaning.negate = (choice & 2U) != 0;
  const auto bytes = input.rest();
  const auto picture = parsePgm({reinterpret_cast<const char*>(bytes.data()), input.left()});
  if (!picture) return require(!picture.reason().empty()), 0;
  require(std::size_t{picture->width} * picture->height <= input.left());
  const auto map = mapOf(*picture, meaning, parameters);
  if (!map) return require(!map.reason().empty()), 0;
  MapCells cells;
  (*map)->snapshot(cells);
  if (!cells.cells.empty()) require(static_cast<bool>(parsePgm(encodePgm(cells))));
  return 0;
}
