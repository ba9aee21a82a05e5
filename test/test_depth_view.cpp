#include "core/cloud/depth_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace pilothouse {
namespace {

constexpr std::uint32_t kMax32 = std::numeric_limits<std::uint32_t>::max();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// A depth image whose every part can be spoilt.
class Depth {
 public:
  explicit Depth(std::string_view encoding, std::uint32_t pixel, std::uint32_t padding = 0)
      : bytes{4, 3, 4 * pixel + padding,     encoding, false, nullptr, 0,
              4, 3, {500.0, 501.0, 1.5, 1.0}},
        data(std::size_t{2} * bytes.step + std::size_t{4} * pixel) {}
  template <class T>
  void put(std::uint32_t row, std::uint32_t col, T value) {
    std::memcpy(&data[std::size_t{row} * bytes.step + col * sizeof(T)], &value, sizeof(T));
  }
  Checked<DepthView> open(const DepthBounds& bounds = {}) {
    bytes.data = data.data();
    bytes.size = data.size();
    return DepthView::open(bytes, bounds);
  }
  std::string reason() { return open().reason(); }

  DepthBytes bytes;
  std::vector<std::uint8_t> data;
};
Depth millimetres() {
  return Depth("16UC1", 2);
}

TEST(DepthView, Reads16UC1AsMillimetres) {
  for (const std::string_view encoding : {"16UC1", "mono16"}) {
    Depth depth(encoding, 2, 6);
    depth.put<std::uint16_t>(0, 0, 1);
    depth.put<std::uint16_t>(2, 3, 65535);
    const auto view = depth.open();
    ASSERT_TRUE(view) << view.reason();
    EXPECT_EQ(view->encoding(), DepthEncoding::kMillimetres16);
    EXPECT_FLOAT_EQ(view->metres(0, 0), 0.001F);
    EXPECT_FLOAT_EQ(view->metres(2, 3), 65.535F);
    EXPECT_EQ(view->metres(1, 1), 0.0F) << "no measurement";
    EXPECT_EQ(view->intrinsics().fy, 501.0);
  }
}

TEST(DepthView, Reads32FC1AsMetres) {
  Depth depth("32FC1", 4, 8);
  const float values[] = {0.5F, kNan, kInf, -kInf, -1.0F, -0.0F, 12.25F, 0.0F};
  for (std::uint32_t i = 0; i < 8; ++i) depth.put(i / 4, i % 4, values[i]);
  const auto view = depth.open();
  ASSERT_TRUE(view) << view.reason();
  EXPECT_EQ(view->metres(0, 0), 0.5F);
  EXPECT_EQ(view->metres(1, 2), 12.25F);
  for (const std::uint32_t i : {1U, 2U, 3U, 4U, 5U, 7U})
    EXPECT_EQ(view->metres(i / 4, i % 4), 0.0F) << "no measurement in " << values[i];
}

TEST(DepthView, RefusesOtherEncodings) {
  for (const std::string encoding : {"", "8UC1", "16SC1", "64FC1", "rgb8", "16UC1 "})
    EXPECT_EQ(Depth(encoding, 2).reason(),
              "depth image encoding is \"" + encoding + "\", expected 16UC1, mono16 or 32FC1");
  EXPECT_EQ(Depth(std::string(40, '\n'), 2).reason(), "depth image encoding is \"" +
                                                          std::string(32, '?') +
                                                          "...\", expected 16UC1, mono16 or 32FC1");
}

TEST(DepthView, RefusesDataTooShort) {
  Depth depth = millimetres();
  depth.data.pop_back();
  EXPECT_EQ(depth.reason(), "depth image data is 23, expected at least 24 bytes");
}

TEST(DepthView, RefusesAnOversizedImage) {
  Depth depth = millimetres();
  depth.bytes.width = kMax32;
  EXPECT_EQ(depth.reason(), "depth image width is 4294967295, expected 1 to 8192 pixels");
  depth.bytes.width = 4;
  depth.bytes.height = 8193;
  EXPECT_EQ(depth.reason(), "depth image height is 8193, expected 1 to 8192 pixels");
  depth.bytes.width = depth.bytes.height = 8192;
  EXPECT_EQ(depth.reason(), "depth image size is 67108864, expected at most 16777216 pixels");
}

TEST(DepthView, RefusesAnImageLargerThanItsBytes) {
  Depth depth = millimetres();
  depth.bytes.width = depth.bytes.height = depth.bytes.info_width = depth.bytes.info_height = 4096;
  EXPECT_EQ(depth.reason(), "depth image step is 8, expected at least width * 2 = 8192 bytes");
  depth.bytes.step = kMax32 - 1;
  EXPECT_EQ(depth.reason(), "depth image data is 24, expected at least 17587891077122 bytes");
}

TEST(DepthView, RefusesAnImageWithoutPixels) {
  Depth depth = millimetres();
  depth.bytes.width = 0;
  EXPECT_EQ(depth.reason(), "depth image width is 0, expected 1 to 8192 pixels");
  depth.bytes.width = 4;
  depth.bytes.height = 0;
  EXPECT_EQ(depth.reason(), "depth image height is 0, expected 1 to 8192 pixels");
}

TEST(DepthView, RefusesAWrongStep) {
  Depth depth = millimetres();
  depth.bytes.step = 7;
  EXPECT_EQ(depth.reason(), "depth image step is 7, expected at least width * 2 = 8 bytes");
  depth.bytes.step = 0;
  EXPECT_EQ(depth.reason(), "depth image step is 0, expected at least width * 2 = 8 bytes");
  depth.bytes.step = 9;
  EXPECT_EQ(depth.reason(), "depth image step is 9, expected a multiple of 2 bytes");
  Depth metres("32FC1", 4);
  metres.bytes.step = 18;
  EXPECT_EQ(metres.reason(), "depth image step is 18, expected a multiple of 4 bytes");
}

TEST(DepthView, RefusesNullData) {
  Depth depth = millimetres();
  depth.open();
  depth.bytes.data = nullptr;
  EXPECT_EQ(DepthView::open(depth.bytes).reason(), "depth image data is null, expected bytes");
}

TEST(DepthView, RefusesBigEndian) {
  Depth depth = millimetres();
  depth.bytes.is_bigendian = true;
  EXPECT_EQ(depth.reason(), "depth image is_bigendian is true, expected false");
}

TEST(DepthView, RefusesACameraInfoOfAnotherSize) {
  Depth depth = millimetres();
  depth.bytes.info_width = 3;
  depth.bytes.info_height = 4;
  EXPECT_EQ(depth.reason(), "CameraInfo size is 3 x 4, expected 4 x 3 as the depth image");
}

TEST(DepthView, RefusesAnUncalibratedCamera) {
  Depth depth = millimetres();
  depth.bytes.intrinsics = {};
  EXPECT_EQ(depth.reason(), "CameraInfo fx and fy are 0, expected a calibrated camera");
}

TEST(DepthView, RefusesImpossibleFocalLengths) {
  for (const double value : {0.0, -500.0, 1e-30, 1e9, double{kNan}, double{kInf}, -double{kInf}}) {
    for (double Intrinsics::*const focal : {&Intrinsics::fx, &Intrinsics::fy}) {
      Depth depth = millimetres();
      depth.bytes.intrinsics.*focal = value;
      const char* name = focal == &Intrinsics::fx ? "fx" : "fy";
      EXPECT_EQ(depth.reason().rfind(std::string("CameraInfo ") + name + " is ", 0), 0U)
          << value << ": " << depth.reason();
      EXPECT_NE(depth.reason().find("expected 1 to 100000 pixels"), std::string::npos);
    }
  }
}

TEST(DepthView, RefusesImpossiblePrincipalPoints) {
  for (const double value : {1e9, -1e9, double{kNan}, double{kInf}}) {
    Depth depth = millimetres();
    depth.bytes.intrinsics.cx = value;
    EXPECT_EQ(depth.reason().rfind("CameraInfo cx is ", 0), 0U) << depth.reason();
    depth = millimetres();
    depth.bytes.intrinsics.cy = value;
    EXPECT_EQ(depth.reason().rfind("CameraInfo cy is ", 0), 0U) << depth.reason();
  }
}

}  // namespace
}  // namespace pilothouse
