// The doors of the players' files: PCD and PNG headers, and the pairing of depth with colour.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/replay/frame_pairs.hpp"
#include "core/replay/pcd_header.hpp"
#include "core/replay/png_header.hpp"

namespace pilothouse {
namespace {

/// A PCD file whose every line can be replaced.
struct Pcd {
  std::vector<std::string> lines{"# .PCD v0.7",  "VERSION 0.7",  "FIELDS x y z rgb",
                                 "SIZE 4 4 4 4", "TYPE F F F U", "COUNT 1 1 1 1",
                                 "WIDTH 2",      "HEIGHT 3",     "VIEWPOINT 0 0 0 1 0 0 0",
                                 "POINTS 6",     "DATA binary"};
  std::string data = std::string(96, '\0');

  Pcd& with(const std::string& line) {
    const std::string key = line.substr(0, line.find(' ') + 1);
    *std::find_if(lines.begin(), lines.end(),
                  [&](const std::string& old) { return old.rfind(key, 0) == 0; }) = line;
    return *this;
  }
  Pcd& without(const std::string& key) {
    lines.erase(std::find_if(lines.begin(), lines.end(),
                             [&](const std::string& old) { return old.rfind(key + " ", 0) == 0; }));
    return *this;
  }
  std::string text() const {
    std::string out;
    for (const std::string& line : lines) out += line + "\n";
    return out + data;
  }
  Checked<PcdHeader> parse() const {
    const std::string file = text();
    return parsePcdHeader(file, file.size());
  }
  std::string reason() const { return parse().reason(); }
};

std::string prefix(std::uint32_t a, std::uint32_t b) {
  std::string out;
  for (const std::uint32_t value : {a, b})
    for (unsigned shift = 0; shift < 32; shift += 8)
      out += static_cast<char>(static_cast<std::uint8_t>(value >> shift));
  return out;
}

TEST(PcdHeader, ReadsAWellFormedFile) {
  const Pcd pcd;
  const auto header = pcd.parse();
  ASSERT_TRUE(header) << header.reason();
  EXPECT_EQ(header->width, 2U);
  EXPECT_EQ(header->height, 3U);
  EXPECT_EQ(header->point_step, 16U);
  EXPECT_EQ(header->data, PcdData::kBinary);
  EXPECT_EQ(header->data_offset, pcd.text().size() - 96);
}

TEST(PcdHeader, ReadsWhatMayBeMissingAndOtherLineEnds) {
  Pcd pcd;
  pcd.without("VERSION").without("VIEWPOINT").without("COUNT");
  for (std::string& line : pcd.lines) line += " \r";
  EXPECT_TRUE(pcd.parse()) << pcd.reason();
}

TEST(PcdHeader, ReadsAsciiAndCompressed) {
  Pcd ascii;
  ascii.with("DATA ascii").data.clear();
  for (int i = 0; i < 6; ++i) ascii.data += "1 2 nan 0\n";
  EXPECT_TRUE(ascii.parse()) << ascii.reason();
  Pcd compressed;
  compressed.with("DATA binary_compressed").data = prefix(20, 96) + std::string(20, '\0');
  EXPECT_TRUE(compressed.parse()) << compressed.reason();
}

TEST(PcdHeader, RefusesAFileWithoutItsPoints) {
  Pcd binary;
  binary.data.pop_back();
  EXPECT_EQ(binary.reason(), "PCD data is 95 bytes, expected at least 96 for 6 points");
  Pcd ascii;
  ascii.with("DATA ascii").data = "1 2 3 0\n1 2 3 0\n";
  EXPECT_EQ(ascii.reason(), "PCD data is 16 bytes, expected at least 47 for 6 points");
  Pcd compressed;
  compressed.with("DATA binary_compressed").data = prefix(20, 96) + std::string(19, '\0');
  EXPECT_EQ(compressed.reason(), "PCD data is 27 bytes, expected at least 28 for 6 points");
  compressed.data = "short";
  EXPECT_EQ(compressed.reason(), "PCD data is 5 bytes, expected at least 8 for 6 points");
}

TEST(PcdHeader, RefusesACompressedSizeThatContradicts) {
  Pcd pcd;
  pcd.with("DATA binary_compressed").data = prefix(4, 0xFFFFFFFFU) + std::string(4, '\0');
  EXPECT_EQ(pcd.reason(), "PCD uncompressed size is 4294967295, expected 96 bytes for 6 points");
}

TEST(PcdHeader, RefusesSizesThatWouldExhaustMemory) {
  EXPECT_EQ(Pcd().with("WIDTH 4294967295").reason(),
            "PCD WIDTH is \"4294967295\", expected 1 to 4194304");
  EXPECT_EQ(Pcd().with("HEIGHT 99999999999999999999999").reason(),
            "PCD HEIGHT is \"99999999999999999999999\", expected 1 to 4194304");
  EXPECT_EQ(Pcd().with("POINTS -6").reason(), "PCD POINTS is \"-6\", expected 1 to 4194304");
  EXPECT_EQ(Pcd().with("POINTS 7").reason(), "PCD POINTS is 7, expected WIDTH * HEIGHT = 6");
  EXPECT_EQ(Pcd().with("COUNT 1 1 1 999999").reason(),
            "PCD COUNT of field \"rgb\" is \"999999\", expected 1 to 4096");
  EXPECT_EQ(Pcd()
                .with("COUNT 1 1 1 4096")
                .with("WIDTH 1000")
                .with("HEIGHT 1000")
                .with("POINTS 1000000")
                .reason(),
            "PCD size is 16396000000 bytes, expected at most 268435456");
}

TEST(PcdHeader, RefusesAFileWithoutXyz) {
  EXPECT_EQ(Pcd().with("FIELDS a y z rgb").reason(), "PCD field x is there 0 times, expected once");
  EXPECT_EQ(Pcd().with("FIELDS x y z z").with("TYPE F F F F").reason(),
            "PCD field z is there 2 times, expected once");
  EXPECT_EQ(Pcd().with("TYPE F U F U").reason(),
            "PCD field \"y\" is not one F of 4 bytes, expected float32");
  EXPECT_EQ(Pcd().with("SIZE 4 8 4 4").reason(),
            "PCD field \"y\" is not one F of 4 bytes, expected float32");
}

TEST(PcdHeader, RefusesFieldListsThatDisagree) {
  EXPECT_EQ(Pcd().with("SIZE 4 4 4").reason(), "PCD SIZE has 3 values, expected one a field, 4");
  EXPECT_EQ(Pcd().without("TYPE").reason(), "PCD TYPE has 0 values, expected one a field, 4");
  EXPECT_EQ(Pcd().with("SIZE 4 4 4 3").reason(),
            "PCD TYPE and SIZE of field \"rgb\" are \"U\" 3, expected I or U with 1, 2, 4 or 8, or "
            "F with 4 or 8");
  std::string many = "FIELDS";
  for (int i = 0; i < 3000; ++i) many += " x";
  EXPECT_EQ(Pcd().with(many).reason(), "PCD FIELDS has 65 names, expected 3 to 64");
}

TEST(PcdHeader, RefusesUnknownRepeatedAndMisplacedKeys) {
  // Readers that look at the first letters only would take WIDTHS for the width.
  Pcd unknown;
  unknown.lines.insert(unknown.lines.begin() + 7, "WIDTHS 4000000000");
  EXPECT_EQ(unknown.reason(),
            "PCD header line is \"WIDTHS\", expected each key once and in the format's order");
  Pcd twice;
  twice.lines.insert(twice.lines.begin() + 7, "WIDTH 4000000000");
  EXPECT_EQ(twice.reason(),
            "PCD header line is \"WIDTH\", expected each key once and in the format's order");
  EXPECT_EQ(Pcd().without("HEIGHT").reason(), "PCD HEIGHT has 0 values, expected 1");
  EXPECT_EQ(Pcd().with("DATA gzip").reason(),
            "PCD DATA is \"gzip\", expected ascii, binary or binary_compressed");
}

TEST(PcdHeader, RefusesWhatIsNoPcdFile) {
  EXPECT_EQ(parsePcdHeader("", 0).reason(),
            "PCD header ends without a DATA line, expected one within 8192 bytes");
  EXPECT_EQ(parsePcdHeader("\x7f"
                           "ELF\1\n",
                           6)
                .reason(),
            "PCD header line is \"?ELF?\", expected each key once and in the format's order");
  EXPECT_EQ(parsePcdHeader(std::string(100000, '\n'), 100000).reason(),
            "PCD header ends without a DATA line, expected one within 8192 bytes");
  EXPECT_EQ(parsePcdHeader("", 1ULL << 40U).reason(),
            "PCD file is 1099511627776 bytes, expected at most 1073741824");
}

TEST(PcdHeader, RefusesEveryTruncation) {
  const std::string file = Pcd().text();
  for (std::size_t size = 0; size < file.size(); ++size)
    EXPECT_FALSE(parsePcdHeader(std::string_view(file).substr(0, size), size)) << size;
}

std::vector<std::uint8_t> png(std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint8_t> bytes{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                  0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  for (const std::uint32_t value : {width, height})
    for (unsigned shift = 32; shift > 0; shift -= 8)
      bytes.push_back(static_cast<std::uint8_t>(value >> (shift - 8)));
  bytes.insert(bytes.end(), {16, 0, 0, 0, 0, 0, 0, 0, 0});
  return bytes;
}

TEST(PngHeader, ReadsSizeAndDepth) {
  const auto bytes = png(640, 480);
  const auto header = parsePngHeader(bytes.data(), bytes.size());
  ASSERT_TRUE(header) << header.reason();
  EXPECT_EQ(header->width, 640U);
  EXPECT_EQ(header->height, 480U);
  EXPECT_EQ(header->bit_depth, 16);
  EXPECT_EQ(header->colour_type, 0);
}

TEST(PngHeader, RefusesSizesThatWouldExhaustMemory) {
  for (const auto& [width, height] :
       {std::pair{0U, 5U}, {5U, 0U}, {8193U, 1U}, {1U, 8193U}, {8192U, 8192U}, {~0U, ~0U}}) {
    const auto bytes = png(width, height);
    EXPECT_EQ(parsePngHeader(bytes.data(), bytes.size()).reason(),
              "PNG size is " + std::to_string(width) + " x " + std::to_string(height) +
                  ", expected 1 to 8192 a side and at most 16777216 pixels");
  }
}

TEST(PngHeader, RefusesWhatIsNoPngFile) {
  auto bytes = png(4, 4);
  EXPECT_EQ(parsePngHeader(bytes.data(), 32).reason(),
            "PNG file is 32 bytes, expected at least 33");
  EXPECT_EQ(parsePngHeader(nullptr, 0).reason(), "PNG file is 0 bytes, expected at least 33");
  bytes[12] = 'J';
  EXPECT_EQ(parsePngHeader(bytes.data(), bytes.size()).reason(),
            "PNG signature is wrong, expected a PNG file");
}

TEST(FramePairs, PairsByNameInOrder) {
  const auto pairs = pairFrames({"2_depth.png", "readme.txt", "1_depth.png", "1_color.png",
                                 "3_color.png", "depth.png", "_depth.png"});
  ASSERT_TRUE(pairs) << pairs.reason();
  ASSERT_EQ(pairs->size(), 3U);
  EXPECT_EQ((*pairs)[0].depth, "1_depth.png");
  EXPECT_EQ((*pairs)[0].colour, "1_color.png");
  EXPECT_EQ((*pairs)[1].depth, "2_depth.png");
  EXPECT_EQ((*pairs)[1].colour, "");
  EXPECT_EQ((*pairs)[2].depth, "_depth.png");
}

TEST(FramePairs, RefusesAFolderWithoutDepth) {
  EXPECT_EQ(pairFrames({"1_color.png", "a"}).reason(),
            "folder has 2 files but none named *_depth.png, expected one a picture");
}

}  // namespace
}  // namespace pilothouse
