#include "core/mapping/octree_bytes.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "core/cloud/quoted.hpp"

namespace pilothouse {
namespace {

constexpr std::string_view kFirstLine = "# Octomap OcTree binary file";
constexpr std::size_t kLongestLine = 256;
constexpr int kDeepest = 16;

/// The line that begins at `at`, which moves behind it; none where it does not end in time.
std::optional<std::string_view> takeLine(std::string_view bytes, std::size_t& at) {
  const std::size_t end = bytes.substr(at, kLongestLine + 1).find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = bytes.substr(at, end);
  at += end + 1;
  return line;
}

/// The text behind "KEY "; none where the line has another key.
std::optional<std::string> valueOf(std::string_view line, std::string_view key) {
  if (line.size() < key.size() + 2 || line.substr(0, key.size()) != key ||
      line[key.size()] != ' ') {
    return std::nullopt;
  }
  return std::string(line.substr(key.size() + 1));
}

bool isWhole(const std::string& text) {
  return !text.empty() && text.size() <= 12 &&
         text.find_first_not_of("0123456789") == std::string::npos;
}
bool isNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.eE+-") == std::string::npos;
}

std::string readHeader(std::string_view bytes, OctreeHeader& header, std::uint64_t& stated) {
  std::size_t at = 0;
  const auto first = takeLine(bytes, at);
  if (!first || *first != kFirstLine) {
    return "the beginning is " + quoted(bytes.substr(0, kFirstLine.size())) + ", expected \"" +
           std::string(kFirstLine) + "\"";
  }
  const char* const keys[] = {"id", "size", "res"};
  std::array<std::string, 3> values;
  for (std::size_t key = 0; key < 3;) {
    const auto line = takeLine(bytes, at);
    if (!line) return "the header ends early, expected id, size, res and data";
    if (!line->empty() && line->front() == '#') continue;
    const auto value = valueOf(*line, keys[key]);
    if (!value) return "a line is " + quoted(*line) + ", expected " + keys[key];
    values[key++] = *value;
  }
  const auto data = takeLine(bytes, at);
  if (!data || *data != "data") return "the line before the nodes is missing, expected data";
  if (values[0] != "OcTree") return "id is " + quoted(values[0]) + ", expected OcTree";
  if (!isWhole(values[1])) return "size is " + quoted(values[1]) + ", expected a whole number";
  stated = std::strtoull(values[1].c_str(), nullptr, 10);
  header.resolution = isNumber(values[2]) ? std::strtod(values[2].c_str(), nullptr) : NAN;
  if (!(header.resolution >= 0.001 && header.resolution <= 10.0)) {
    return "res is " + quoted(values[2]) + ", expected 0.001 to 10 m";
  }
  header.data_offset = at;
  return {};
}

/// Counts the nodes, in the order in which OctoMap reads them: each inner node tells of its eight
/// children in two bits each, then those of them that are inner follow.
std::string walkNodes(std::string_view data, const OctreeBounds& bounds, std::uint64_t& nodes) {
  std::array<int, kDeepest + 1> left{};  // inner nodes at each depth that are still to be read
  int depth = 0;
  left[0] = 1;
  nodes = 1;
  std::size_t at = 0;
  while (depth >= 0) {
    const auto level = static_cast<std::size_t>(depth);
    if (left[level] == 0) {
      --depth;
      continue;
    }
    --left[level];
    if (data.size() - at < 2) {
      return "the nodes end after " + std::to_string(at) + " bytes, expected more";
    }
    unsigned word = static_cast<std::uint8_t>(data[at]) |
                    static_cast<unsigned>(static_cast<std::uint8_t>(data[at + 1])) << 8U;
    at += 2;
    if (word == 0) return "an inner node has no children, expected at least one";
    int inner = 0;
    for (; word != 0; word >>= 2U) {
      if ((word & 3U) != 0) ++nodes;
      if ((word & 3U) == 3U) ++inner;
    }
    if (nodes > bounds.max_nodes) {
      return "the tree has more than " + std::to_string(bounds.max_nodes) + " nodes";
    }
    if (inner == 0) continue;
    if (depth + 1 >= kDeepest) return "the tree is deeper than 16 levels";
    left[level + 1] = inner;
    ++depth;
  }
  if (at == data.size()) return {};
  return "the nodes end after " + std::to_string(at) + " bytes, but " +
         std::to_string(data.size()) + " are there";
}

}  // namespace

Checked<OctreeHeader> checkOctree(std::string_view bytes, const OctreeBounds& bounds) {
  using Result = Checked<OctreeHeader>;
  OctreeHeader header;
  std::uint64_t stated = 0;
  std::string fault = readHeader(bytes, header, stated);
  if (!fault.empty()) return Result::refused(fault);
  const std::string_view data = bytes.substr(header.data_offset);
  if (stated > 0) fault = walkNodes(data, bounds, header.nodes);
  if (fault.empty() && stated == 0 && !data.empty()) fault = "size is 0, but nodes follow";
  if (!fault.empty()) return Result::refused(fault);
  if (header.nodes != stated) {
    return Result::refused("size is " + std::to_string(stated) + ", but the file holds " +
                           std::to_string(header.nodes) + " nodes");
  }
  return Result::of(header);
}

}  // namespace pilothouse
