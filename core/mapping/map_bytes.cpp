#include "core/mapping/map_bytes.hpp"

#include <cmath>
#include <cstring>
#include <sstream>

#include "core/cloud/quoted.hpp"
#include "core/mapping/checksum.hpp"

namespace pilothouse {
namespace {

constexpr char kMagic[] = "PHMAP\r\n\x1A";
constexpr std::size_t kMagicBytes = 8;
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kBlock = OccupancyMap::kBlock;

void append(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i));
}
void append(std::string& bytes, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  append(bytes, bits, 8);
}
std::uint64_t take(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) {
    value |= std::uint64_t{static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(i)])}
             << (8 * i);
  }
  return value;
}
std::uint32_t take32(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(take(bytes, at, 4));
}
double takeDouble(std::string_view bytes, std::size_t at) {
  const std::uint64_t bits = take(bytes, at, 8);
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

template <class Value, class Expected>
std::string wrong(const char* thing, const Value& value, const Expected& expected) {
  std::ostringstream text;
  text << thing << " is " << value << ", expected " << expected;
  return text.str();
}

std::string headerFault(std::string_view bytes) {
  if (bytes.size() < kMapHeaderBytes) {
    return wrong("size", std::to_string(bytes.size()) + " bytes",
                 "at least " + std::to_string(kMapHeaderBytes));
  }
  if (bytes.substr(0, kMagicBytes) != std::string_view(kMagic, kMagicBytes)) {
    return wrong("the beginning", quoted(bytes.substr(0, kMagicBytes)), "that of a map, PHMAP");
  }
  const std::uint32_t version = take32(bytes, 8);
  if (version != kVersion) return wrong("version", version, kVersion);
  const std::uint32_t crc = take32(bytes, 60), own = crc32(bytes.substr(0, 60));
  if (crc != own) return wrong("the header's checksum", crc, own);
  if (take32(bytes, 12) != kMapHeaderBytes) {
    return wrong("the header's size", take32(bytes, 12), kMapHeaderBytes);
  }
  if (take32(bytes, 40) != kBlock) return wrong("cells a block", take32(bytes, 40), kBlock);
  const std::uint64_t blocks = take32(bytes, 44);
  const std::uint64_t size = kMapHeaderBytes + blocks * kMapBlockBytes;
  if (take(bytes, 48, 8) != size) return wrong("the stated size", take(bytes, 48, 8), size);
  if (bytes.size() != size) return wrong("size", std::to_string(bytes.size()) + " bytes", size);
  const std::uint32_t data_crc = take32(bytes, 56), data_own = crc32(bytes.substr(64));
  if (data_crc != data_own) return wrong("the data's checksum", data_crc, data_own);
  return {};
}

std::string placeFault(std::string_view bytes) {
  const double size = takeDouble(bytes, 16);
  for (const std::size_t at : {24, 32}) {
    const double anchor = takeDouble(bytes, at);
    if (!(std::abs(anchor) <= size)) {
      return wrong("the corner of cell 0", anchor, "within a cell of 0");
    }
  }
  return {};
}

std::string readBlock(std::string_view bytes, OccupancyMap& map) {
  const auto column = static_cast<std::int32_t>(take32(bytes, 0));
  const auto row = static_cast<std::int32_t>(take32(bytes, 4));
  const std::size_t before = map.blockCount();
  OccupancyMap::Block* block = map.ensureBlock(column, row);
  const std::string name = "block (" + std::to_string(column) + ", " + std::to_string(row) + ")";
  if (block == nullptr) {
    return name + " lies outside of the map's square of " +
           std::to_string(map.parameters().max_side) + " m";
  }
  if (map.blockCount() == before) return name + " is there twice";
  for (std::size_t i = 0; i < block->size(); ++i) {
    MapCellState& cell = (*block)[i];
    cell.odds = static_cast<std::int16_t>(take(bytes, 8 + 4 * i, 2));
    cell.threshold = static_cast<std::int8_t>(take(bytes, 10 + 4 * i, 1));
    cell.drop_off = static_cast<std::int8_t>(take(bytes, 11 + 4 * i, 1));
    if (std::abs(int{cell.odds}) > CellRule::kMostOdds) {
      return wrong("log-odds", cell.odds, "within 3000");
    }
    if (std::abs(int{cell.threshold}) > CellRule::kMostKind ||
        std::abs(int{cell.drop_off}) > CellRule::kMostKind) {
      return wrong("a cell's kind", int{cell.threshold}, "within 3");
    }
  }
  return {};
}

}  // namespace

std::string encodeMap(const OccupancyMap& map) {
  std::string data;
  data.reserve(map.blockCount() * kMapBlockBytes);
  std::uint32_t blocks = 0;
  map.forEachBlock([&](int column, int row, const OccupancyMap::Block& block) {
    ++blocks;
    append(data, static_cast<std::uint32_t>(column), 4);
    append(data, static_cast<std::uint32_t>(row), 4);
    for (const MapCellState& cell : block) {
      append(data, static_cast<std::uint16_t>(cell.odds), 2);
      append(data, static_cast<std::uint8_t>(cell.threshold), 1);
      append(data, static_cast<std::uint8_t>(cell.drop_off), 1);
    }
  });
  std::string bytes(kMagic, kMagicBytes);
  append(bytes, kVersion, 4);
  append(bytes, kMapHeaderBytes, 4);
  append(bytes, map.parameters().cell_size);
  append(bytes, map.anchor().x());
  append(bytes, map.anchor().y());
  append(bytes, kBlock, 4);
  append(bytes, blocks, 4);
  append(bytes, kMapHeaderBytes + data.size(), 8);
  append(bytes, crc32(data), 4);
  append(bytes, crc32(bytes), 4);
  return bytes + data;
}

Checked<std::shared_ptr<OccupancyMap>> decodeMap(std::string_view bytes,
                                                 const OccupancyParameters& parameters) {
  using Result = Checked<std::shared_ptr<OccupancyMap>>;
  std::string fault = headerFault(bytes);
  if (!fault.empty()) return Result::refused(fault);
  OccupancyParameters own = parameters;
  own.cell_size = takeDouble(bytes, 16);
  const auto faults = validate(own);
  if (!faults.empty()) return Result::refused(faults.front());
  fault = placeFault(bytes);
  if (!fault.empty()) return Result::refused(fault);
  const auto map = std::make_shared<OccupancyMap>(own);
  map->setAnchor({takeDouble(bytes, 24), takeDouble(bytes, 32)});
  for (std::size_t at = kMapHeaderBytes; at < bytes.size(); at += kMapBlockBytes) {
    fault = readBlock(bytes.substr(at, kMapBlockBytes), *map);
    if (!fault.empty()) return Result::refused(fault);
  }
  return Result::of(map);
}

}  // namespace pilothouse
