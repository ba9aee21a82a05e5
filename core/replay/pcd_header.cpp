#include "core/replay/pcd_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/quoted.hpp"

namespace pilothouse {
namespace {

using Words = std::vector<std::string_view>;
using Reason = std::optional<std::string>;

/// In the order in which the format demands them.
constexpr std::array<std::string_view, 10> kKeys{
    "VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
enum Key { kVersion, kFields, kSize, kType, kCount, kWidth, kHeight, kViewpoint, kPoints, kData };

/// The words after each key; empty where the key is missing.
struct Lines {
  std::array<Words, kKeys.size()> values;
  std::size_t data_offset = 0;
  Reason fault;
};

/// At most `most` words of a line: a line of 8 kB can make no larger a list.
Words split(std::string_view line, std::size_t most) {
  Words words;
  while (words.size() < most) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) break;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return words;
}

Lines readLines(std::string_view head, std::size_t most_words) {
  Lines lines;
  const std::string_view window = head.substr(0, kLargestPcdHeader);
  std::size_t at = 0, next_key = 0;
  while (next_key < kKeys.size()) {
    const std::size_t end = window.find('\n', at);
    if (end == std::string_view::npos) {
      lines.fault = "PCD header ends without a DATA line, expected one within " +
                    std::to_string(kLargestPcdHeader) + " bytes";
      return lines;
    }
    Words words = split(window.substr(at, end - at), most_words);
    at = end + 1;
    if (words.empty() || words[0][0] == '#') continue;
    const auto* key = std::find(kKeys.begin(), kKeys.end(), words[0]);
    const auto index = static_cast<std::size_t>(key - kKeys.begin());
    if (key == kKeys.end() || index < next_key) {
      lines.fault = "PCD header line is " + quoted(words[0]) +
                    ", expected each key once and in the format's order";
      return lines;
    }
    words.erase(words.begin());
    lines.values[index] = std::move(words);
    next_key = index + 1;
  }
  lines.data_offset = at;
  return lines;
}

/// A whole number from `low` to `high`, or a fault naming `thing`.
std::uint32_t number(std::string_view word, const std::string& thing, std::uint64_t low,
                     std::uint64_t high, Reason& fault) {
  std::uint64_t value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  const bool sound = !word.empty() && error == std::errc() && stop == end && value >= low &&
                     value <= high && value <= UINT32_MAX;
  if (sound) return static_cast<std::uint32_t>(value);
  if (!fault)
    fault = "PCD " + thing + " is " + quoted(word) + ", expected " + std::to_string(low) + " to " +
            std::to_string(high);
  return 0;
}

/// The one number of a line, from 1 to `high`.
std::uint32_t onlyNumber(const Lines& lines, Key key, std::uint64_t high, Reason& fault) {
  const Words& words = lines.values[key];
  if (words.size() != 1 && !fault)
    fault = "PCD " + std::string(kKeys[key]) + " has " + std::to_string(words.size()) +
            " values, expected 1";
  return fault ? 0 : number(words[0], std::string(kKeys[key]), 1, high, fault);
}

struct PointLayout {
  std::uint64_t step = 0;    ///< bytes
  std::uint64_t values = 0;  ///< numbers a point
};

/// Also checks that x y z are single float32 numbers.
PointLayout pointLayout(const Lines& lines, const PcdBounds& bounds, Reason& fault) {
  const Words& names = lines.values[kFields];
  if (names.empty() || names.size() > bounds.max_fields) {
    fault = "PCD FIELDS has " + std::to_string(names.size()) + " names, expected 3 to " +
            std::to_string(bounds.max_fields);
    return {};
  }
  for (const Key key : {kSize, kType, kCount}) {
    if (key == kCount && lines.values[key].empty()) continue;  // means 1 for all
    if (lines.values[key].size() == names.size()) continue;
    fault = "PCD " + std::string(kKeys[key]) + " has " + std::to_string(lines.values[key].size()) +
            " values, expected one a field, " + std::to_string(names.size());
    return {};
  }
  std::array<int, 3> axes{};
  PointLayout layout;
  for (std::size_t i = 0; i < names.size() && !fault; ++i) {
    const std::string thing = " of field " + quoted(names[i]);
    const std::uint32_t size = number(lines.values[kSize][i], "SIZE" + thing, 1, 8, fault);
    const bool plain = lines.values[kCount].empty();
    const std::uint32_t count =
        plain ? 1 : number(lines.values[kCount][i], "COUNT" + thing, 1, 4096, fault);
    const std::string_view type = lines.values[kType][i];
    const bool power = size == 1 || size == 2 || size == 4 || size == 8;
    if (!fault &&
        (!power || (type != "I" && type != "U" && type != "F") || (type == "F" && size < 4)))
      fault = "PCD TYPE and SIZE" + thing + " are " + quoted(type) + " " + std::to_string(size) +
              ", expected I or U with 1, 2, 4 or 8, or F with 4 or 8";
    layout.step += std::uint64_t{size} * count;
    layout.values += count;
    if (names[i] != "x" && names[i] != "y" && names[i] != "z") continue;
    ++axes[static_cast<std::size_t>(names[i][0] - 'x')];
    if (!fault && (size != 4 || type != "F" || count != 1))
      fault = "PCD field " + quoted(names[i]) + " is not one F of 4 bytes, expected float32";
  }
  for (std::size_t axis = 0; axis < 3 && !fault; ++axis)
    if (axes[axis] != 1)
      fault = "PCD field " + std::string(1, "xyz"[axis]) + " is there " +
              std::to_string(axes[axis]) + " times, expected once";
  return layout;
}

std::optional<PcdData> codingOf(std::string_view word) {
  if (word == "ascii") return PcdData::kAscii;
  if (word == "binary") return PcdData::kBinary;
  if (word == "binary_compressed") return PcdData::kBinaryCompressed;
  return {};
}

std::uint32_t littleEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

/// Whether the file holds the points that its header announces.
Reason dataFault(std::string_view head, std::uint64_t file_size, const PcdHeader& header,
                 std::uint64_t values) {
  const std::uint64_t points = std::uint64_t{header.width} * header.height;
  const std::uint64_t bytes = points * header.point_step;
  const std::uint64_t left = file_size - header.data_offset;
  const auto tooShort = [&](std::uint64_t needed) {
    return "PCD data is " + std::to_string(left) + " bytes, expected at least " +
           std::to_string(needed) + " for " + std::to_string(points) + " points";
  };
  if (header.data == PcdData::kBinary && left < bytes) return tooShort(bytes);
  // A value takes a digit and a blank, the last of the file only the digit.
  if (header.data == PcdData::kAscii && left + 1 < points * values * 2)
    return tooShort(points * values * 2 - 1);
  if (header.data != PcdData::kBinaryCompressed) return {};
  if (left < 8 || head.size() < header.data_offset + 8) return tooShort(8);
  const std::uint32_t compressed = littleEndian(head.substr(header.data_offset, 4));
  const std::uint32_t uncompressed = littleEndian(head.substr(header.data_offset + 4, 4));
  if (left - 8 < compressed) return tooShort(std::uint64_t{compressed} + 8);
  if (uncompressed != bytes)
    return "PCD uncompressed size is " + std::to_string(uncompressed) + ", expected " +
           std::to_string(bytes) + " bytes for " + std::to_string(points) + " points";
  return {};
}

}  // namespace

Checked<PcdHeader> parsePcdHeader(std::string_view head, std::uint64_t file_size,
                                  const PcdBounds& bounds) {
  using Result = Checked<PcdHeader>;
  if (file_size > bounds.max_file)
    return Result::refused("PCD file is " + std::to_string(file_size) +
                           " bytes, expected at most " + std::to_string(bounds.max_file));
  head = head.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(head.size(), file_size)));
  const Lines lines = readLines(head, bounds.max_fields + 2);
  Reason fault = lines.fault;
  if (fault) return Result::refused(*fault);

  PcdHeader header;
  header.data_offset = lines.data_offset;
  const PointLayout layout = pointLayout(lines, bounds, fault);
  header.point_step = static_cast<std::uint32_t>(layout.step);
  header.width = onlyNumber(lines, kWidth, bounds.max_points, fault);
  header.height = onlyNumber(lines, kHeight, bounds.max_points, fault);
  const std::uint32_t points = onlyNumber(lines, kPoints, bounds.max_points, fault);
  if (fault) return Result::refused(*fault);
  if (std::uint64_t{header.width} * header.height != points)
    return Result::refused("PCD POINTS is " + std::to_string(points) +
                           ", expected WIDTH * HEIGHT = " +
                           std::to_string(std::uint64_t{header.width} * header.height));
  if (std::uint64_t{points} * header.point_step > bounds.max_bytes)
    return Result::refused("PCD size is " +
                           std::to_string(std::uint64_t{points} * header.point_step) +
                           " bytes, expected at most " + std::to_string(bounds.max_bytes));

  const std::string_view word = lines.values[kData].empty() ? "" : lines.values[kData][0];
  const std::optional<PcdData> coding = codingOf(word);
  if (!coding)
    return Result::refused("PCD DATA is " + quoted(word) +
                           ", expected ascii, binary or binary_compressed");
  header.data = *coding;
  fault = dataFault(head, file_size, header, layout.values);
  return fault ? Result::refused(*fault) : Result::of(header);
}

}  // namespace pilothouse
