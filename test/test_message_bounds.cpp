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

const std::vector<std::tuple<const char*, Bytes, Check>> kMessages{
    {"PointCloud2", cloud(), [](const Bytes& b) { return pointCloud2Fault(b.data(), b.size()); }},
    {"Image", image(), [](const Bytes& b) { return imageFault(b.data(), b.size()); }},
    {"CompressedImage", compressed(),
     [](const Bytes& b) { return compressedImageFault(b.data(), b.size()); }},
    {"CameraInfo", cameraInfo(),
     [](const Bytes& b) { return cameraInfoFault(b.data(), b.size()); }},
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
      const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
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

TEST(MessageBounds, RefusesALongName) {
  const Bytes bytes = Wire().zeros(12).text(std::string(1025, 'a')).zeros(5000).bytes;
  for (const auto& [name, unused, check] : kMessages)
    EXPECT_EQ(reason(check(bytes)), "length of frame_id is 1025, expected 0 to 1024") << name;
}

}  // namespace
}  // namespace pilothouse
