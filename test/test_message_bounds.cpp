#include "core/cloud/message_bounds.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace pilothouse {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Check = std::function<std::optional<LengthFault>(const Bytes&)>;

/// Writes the ROS 1 wire format by hand, so that any length can be made to lie.
class Wire {
 public:
  Wire& u8(std::uint8_t value) { return bytes.push_back(value), *this; }
  Wire& u32(std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) u8(static_cast<std::uint8_t>(value >> shift));
    return *this;
  }
  Wire& text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes.insert(bytes.end(), value.begin(), value.end());
    return *this;
  }
  Wire& zeros(std::size_t count) { return bytes.resize(bytes.size() + count), *this; }
  Wire& header() { return zeros(12).text("camera"); }
  Bytes bytes;
};

Bytes cloud(std::uint32_t claimed_fields = 1, std::uint32_t claimed_data = 4) {
  return Wire()
      .header()
      .u32(1)
      .u32(1)
      .u32(claimed_fields)
      .text("x")
      .u32(0)
      .u8(7)
      .u32(1)
      .u8(0)
      .u32(4)
      .u32(4)
      .u32(claimed_data)
      .zeros(4)
      .u8(1)
      .bytes;
}
Bytes image(std::uint32_t claimed_data = 2) {
  return Wire().header().u32(1).u32(1).text("16UC1").u8(0).u32(2).u32(claimed_data).zeros(2).bytes;
}
Bytes compressed() {
  return Wire().header().text("jpeg").u32(3).zeros(3).bytes;
}
Bytes cameraInfo(std::uint32_t claimed_d = 5) {
  return Wire()
      .header()
      .u32(1)
      .u32(1)
      .text("plumb_bob")
      .u32(claimed_d)
      .zeros(40)
      .zeros(240)
      .zeros(25)
      .bytes;
}

/// One length that a FloorGrid or ObjectList claims; the bytes after it stay those of the good one.
struct Claims {
  std::uint32_t frame = 6, classes = 2, heights = 2, deviations = 2, method = 8;
  std::uint32_t source = 6, sources = 1, source_name = 6, objects = 2;
};
Bytes floorGrid(const Claims& claims = {}) {
  return Wire()
      .zeros(12)
      .u32(claims.frame)
      .zeros(6)
      .zeros(76)
      .u32(claims.classes)
      .zeros(2)
      .u32(claims.heights)
      .zeros(8)
      .u32(claims.deviations)
      .zeros(8)
      .u32(claims.method)
      .zeros(8)
      .bytes;
}
Bytes objectList(const Claims& claims = {}) {
  return Wire()
      .zeros(12)
      .u32(claims.frame)
      .zeros(6)
      .u32(claims.source)
      .zeros(6)
      .u32(claims.sources)
      .u32(claims.source_name)
      .zeros(6)
      .zeros(12)
      .u32(claims.objects)
      .zeros(42)
      .bytes;
}
Bytes path(std::uint32_t claimed_poses = 2) {
  return Wire().header().u32(claimed_poses).header().zeros(56).header().zeros(56).bytes;
}

const std::vector<std::tuple<const char*, Bytes, Check>> kMessages{
    {"PointCloud2", cloud(), [](const Bytes& b) { return pointCloud2Fault(b.data(), b.size()); }},
    {"Image", image(), [](const Bytes& b) { return imageFault(b.data(), b.size()); }},
    {"CompressedImage", compressed(),
     [](const Bytes& b) { return compressedImageFault(b.data(), b.size()); }},
    {"CameraInfo", cameraInfo(),
     [](const Bytes& b) { return cameraInfoFault(b.data(), b.size()); }},
    {"FloorGrid", floorGrid(), [](const Bytes& b) { return floorGridFault(b.data(), b.size()); }},
    {"ObjectList", objectList(),
     [](const Bytes& b) { return objectListFault(b.data(), b.size()); }},
    {"Path", path(), [](const Bytes& b) { return pathFault(b.data(), b.size()); }},
};

std::string reason(const std::optional<LengthFault>& fault) {
  return fault ? describe(*fault) : std::string();
}

TEST(MessageBounds, AcceptsWhatIsWellFormed) {
  for (const auto& [name, bytes, check] : kMessages) EXPECT_EQ(reason(check(bytes)), "") << name;
}

TEST(MessageBounds, RefusesEveryTruncation) {
  for (const auto& [name, bytes, check] : kMessages)
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      cut.shrink_to_fit();  // so that a sanitizer sees a step beyond
      EXPECT_TRUE(check(cut)) << name << " cut to " << size;
    }
}

TEST(MessageBounds, RefusesBytesAfterTheMessage) {
  for (const auto& [name, bytes, check] : kMessages) {
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_EQ(reason(check(longer)), "length of bytes after the message is 1, expected 0 to 0")
        << name;
  }
}

TEST(MessageBounds, RefusesNull) {
  EXPECT_TRUE(pointCloud2Fault(nullptr, 0));
  EXPECT_TRUE(imageFault(nullptr, 100));
}

TEST(MessageBounds, RefusesA64ByteCloudThatClaims40MillionFields) {
  Bytes bomb = Wire().header().u32(1).u32(1).u32(40000000).bytes;
  bomb.resize(64);
  EXPECT_EQ(reason(pointCloud2Fault(bomb.data(), bomb.size())),
            "length of PointCloud2 fields is 40000000, expected 0 to 2");
  bomb.resize(1U << 20U);  // enough bytes for more than the bound
  EXPECT_EQ(reason(pointCloud2Fault(bomb.data(), bomb.size())),
            "length of PointCloud2 fields is 40000000, expected 0 to 64");
}

TEST(MessageBounds, RefusesDataThatIsNotThere) {
  const Bytes short_cloud = cloud(1, 0xFFFFFFFFU);
  EXPECT_EQ(reason(pointCloud2Fault(short_cloud.data(), short_cloud.size())),
            "length of PointCloud2 data is 4294967295, expected 0 to 5");
  const Bytes short_image = image(0x80000000U);
  EXPECT_EQ(reason(imageFault(short_image.data(), short_image.size())),
            "length of Image data is 2147483648, expected 0 to 2");
}

TEST(MessageBounds, RefusesCoefficientsThatAreNotThere) {
  const Bytes bytes = cameraInfo(0x20000001U);  // times 8 is 8 in 32 bits
  EXPECT_EQ(reason(cameraInfoFault(bytes.data(), bytes.size())),
            "length of CameraInfo D is 536870913, expected 0 to 38");
}

TEST(MessageBounds, RefusesAnyLengthOfAFloorGridThatLies) {
  const auto refusal = [](std::uint32_t Claims::*length, std::uint32_t value) {
    Claims claims;
    claims.*length = value;
    const Bytes bytes = floorGrid(claims);
    return reason(floorGridFault(bytes.data(), bytes.size()));
  };
  // Too long for the bytes, from the first byte too many to what overflows 32 bits.
  EXPECT_EQ(refusal(&Claims::frame, 1500000000),
            "length of frame_id is 1500000000, expected 0 to 124");
  EXPECT_EQ(refusal(&Claims::classes, 1500000000),
            "length of FloorGrid classes is 1500000000, expected 0 to 38");
  EXPECT_EQ(refusal(&Claims::heights, 0x40000001U),
            "length of FloorGrid heights is 1073741825, expected 0 to 8");
  EXPECT_EQ(refusal(&Claims::deviations, 6),
            "length of FloorGrid deviations is 6, expected 0 to 5");
  EXPECT_EQ(refusal(&Claims::method, 9), "length of FloorGrid method is 9, expected 0 to 8");
  // Too short: what follows is then read from the wrong place.
  EXPECT_NE(refusal(&Claims::classes, 1), "");
  EXPECT_NE(refusal(&Claims::heights, 1), "");
  EXPECT_NE(refusal(&Claims::deviations, 0), "");
  EXPECT_EQ(refusal(&Claims::method, 7), "length of bytes after the message is 1, expected 0 to 0");
}

TEST(MessageBounds, RefusesAnyLengthOfAnObjectListThatLies) {
  const auto refusal = [](std::uint32_t Claims::*length, std::uint32_t value) {
    Claims claims;
    claims.*length = value;
    const Bytes bytes = objectList(claims);
    return reason(objectListFault(bytes.data(), bytes.size()));
  };
  EXPECT_EQ(refusal(&Claims::frame, 89), "length of frame_id is 89, expected 0 to 88");
  EXPECT_EQ(refusal(&Claims::source, 79), "length of ObjectList source is 79, expected 0 to 78");
  EXPECT_EQ(refusal(&Claims::sources, 5), "length of ObjectList sources is 5, expected 0 to 4");
  EXPECT_EQ(refusal(&Claims::source_name, 65),
            "length of ObjectList source name is 65, expected 0 to 64");
  EXPECT_EQ(refusal(&Claims::objects, 204522253U),  // times 21 is 17 in 32 bits
            "length of ObjectList objects is 204522253, expected 0 to 2");
  EXPECT_EQ(refusal(&Claims::objects, 3), "length of ObjectList objects is 3, expected 0 to 2");
  EXPECT_EQ(refusal(&Claims::objects, 1),
            "length of bytes after the message is 21, expected 0 to 0");
}

TEST(MessageBounds, RefusesPosesThatAreNotThere) {
  const Bytes bytes = path(0x80000000U);
  EXPECT_EQ(reason(pathFault(bytes.data(), bytes.size())),
            "length of Path poses is 2147483648, expected 0 to 2");
  const Bytes three = path(3);
  EXPECT_NE(reason(pathFault(three.data(), three.size())), "");
}

TEST(MessageBounds, RefusesMoreCellsOrObjectsThanAnyFloorHas) {
  const auto grid = [](std::size_t cells) {
    const auto count = static_cast<std::uint32_t>(cells);
    const Bytes bytes = Wire()
                            .header()
                            .zeros(76)
                            .u32(count)
                            .zeros(cells)
                            .u32(count)
                            .zeros(4 * cells)
                            .u32(count)
                            .zeros(4 * cells)
                            .text("original")
                            .bytes;
    return reason(floorGridFault(bytes.data(), bytes.size()));
  };
  EXPECT_EQ(grid(1000000), "");
  EXPECT_EQ(grid(1000001), "length of FloorGrid classes is 1000001, expected 0 to 1000000");
  const auto list = [](std::size_t objects) {
    const Bytes bytes = Wire()
                            .header()
                            .text("camera")
                            .u32(0)
                            .u32(static_cast<std::uint32_t>(objects))
                            .zeros(21 * objects)
                            .bytes;
    return reason(objectListFault(bytes.data(), bytes.size()));
  };
  EXPECT_EQ(list(1000000), "");
  EXPECT_EQ(list(1000001), "length of ObjectList objects is 1000001, expected 0 to 1000000");
}

TEST(MessageBounds, RefusesALongName) {
  const Bytes bytes = Wire().zeros(12).text(std::string(1025, 'a')).zeros(5000).bytes;
  for (const auto& [name, unused, check] : kMessages)
    EXPECT_EQ(reason(check(bytes)), "length of frame_id is 1025, expected 0 to 1024") << name;
}

}  // namespace
}  // namespace pilothouse
