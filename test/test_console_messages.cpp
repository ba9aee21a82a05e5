// Messages into pictures: right values from good ones, a reason from bad ones, never a crash.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "doors/guarded_subscriber.hpp"
#include "gui/model/class_colours.hpp"
#include "gui/model/conversions.hpp"
#include "gui/model/diagnostics_board.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

sensor_msgs::Image depthImage(std::uint32_t width, std::uint32_t height) {
  sensor_msgs::Image image;
  image.width = width;
  image.height = height;
  image.step = width * 2;
  image.encoding = "16UC1";
  image.data.resize(std::size_t{image.step} * height);
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
    const auto millimetres = static_cast<std::uint16_t>(1000 + i);
    std::memcpy(&image.data[i * 2], &millimetres, 2);
  }
  return image;
}

sensor_msgs::CameraInfo infoOf(const sensor_msgs::Image& image) {
  sensor_msgs::CameraInfo info;
  info.width = image.width;
  info.height = image.height;
  info.K = {500, 0, 8, 0, 500, 6, 0, 0, 1};
  info.P = {500, 0, 8, 0, 0, 500, 6, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::PointCloud2 organisedCloud(std::uint32_t width, std::uint32_t height) {
  sensor_msgs::PointCloud2 cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.point_step = 16;
  cloud.row_step = 16 * width;
  const char* names[] = {"x", "y", "z", "rgb"};
  for (std::uint32_t i = 0; i < 4; ++i) {
    sensor_msgs::PointField field;
    field.name = names[i];
    field.offset = 4 * i;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.data.resize(std::size_t{cloud.row_step} * height);
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
    const float point[3] = {0.0F, 0.0F, i == 0 ? NAN : 1.0F + static_cast<float>(i)};
    const std::uint8_t bgr[4] = {10, 20, 30, 0};
    std::memcpy(&cloud.data[i * 16], point, 12);
    std::memcpy(&cloud.data[i * 16 + 12], bgr, 4);
  }
  return cloud;
}

TEST(Depth, metresOfAnImageAndColoursThatReadBack) {
  DepthConverter converter;
  const auto image = depthImage(16, 12);
  const auto info = infoOf(image);
  const auto result = converter.fromImage(image, &info);
  ASSERT_TRUE(result) << result.reason();
  const DepthPicture& picture = **result;
  EXPECT_FLOAT_EQ(picture.at(3, 2), 1.0F + 0.001F * (2 * 16 + 3));
  EXPECT_EQ(picture.at(16, 0), 0.0F);
  EXPECT_EQ(picture.at(-1, 0), 0.0F);
  ASSERT_TRUE(picture.intrinsics);
  EXPECT_DOUBLE_EQ(picture.intrinsics->fx, 500);
  const float step = (picture.span.far_m - picture.span.near_m) / 255.0F;
  EXPECT_NEAR(DepthRamp().metres(picture.image.pixel(3, 2), picture.span), picture.at(3, 2), step);
}

TEST(Depth, imageWithoutInfoIsShownWithoutIntrinsics) {
  DepthConverter converter;
  const auto result = converter.fromImage(depthImage(16, 12), nullptr);
  ASSERT_TRUE(result) << result.reason();
  EXPECT_FALSE((*result)->intrinsics);
}

TEST(Depth, badImagesAreRefusedWithAReason) {
  DepthConverter converter;
  const auto refused = [&](void (*spoil)(sensor_msgs::Image&)) {
    auto image = depthImage(16, 12);
    spoil(image);
    const auto result = converter.fromImage(image, nullptr);
    return !result && !result.reason().empty();
  };
  EXPECT_TRUE(refused([](auto& i) { i.data.resize(17); }));
  EXPECT_TRUE(refused([](auto& i) { i.step = 3; }));
  EXPECT_TRUE(refused([](auto& i) { i.width = 0; }));
  EXPECT_TRUE(refused([](auto& i) { i.width = i.height = 0xffffffff; }));
  EXPECT_TRUE(refused([](auto& i) { i.encoding = "rgb8"; }));
  auto info = infoOf(depthImage(16, 12));
  info.width = 640;
  EXPECT_FALSE(converter.fromImage(depthImage(16, 12), &info));
}

TEST(Cloud, givesDepthAndColour) {
  DepthConverter converter;
  const auto cloud = organisedCloud(8, 6);
  const auto depth = converter.fromCloud(cloud);
  ASSERT_TRUE(depth) << depth.reason();
  EXPECT_EQ((*depth)->at(0, 0), 0.0F);
  EXPECT_FLOAT_EQ((*depth)->at(2, 1), 11.0F);
  const auto colour = colourFromCloud(cloud);
  ASSERT_TRUE(colour) << colour.reason();
  EXPECT_EQ((*colour)->image.pixel(2, 1), qRgb(30, 20, 10));
}

TEST(Cloud, badOnesAreRefusedWithAReason) {
  DepthConverter converter;
  const auto refused = [&](void (*spoil)(sensor_msgs::PointCloud2&)) {
    auto cloud = organisedCloud(8, 6);
    spoil(cloud);
    const auto depth = converter.fromCloud(cloud);
    const auto colour = colourFromCloud(cloud);
    return !depth && !depth.reason().empty() && !colour && !colour.reason().empty();
  };
  EXPECT_TRUE(refused([](auto& c) { c.data.resize(100); }));
  EXPECT_TRUE(refused([](auto& c) { c.width = c.height = 0xffffffff; }));
  EXPECT_TRUE(refused([](auto& c) { c.row_step = 1; }));
  EXPECT_TRUE(refused([](auto& c) { c.fields.clear(); }));
  EXPECT_TRUE(refused([](auto& c) { c.fields[2].offset = 0xfffffff0; }));
  EXPECT_TRUE(refused([](auto& c) {
    c.width = 48;
    c.height = 1;
    c.row_step = 48 * 16;
  }));
  auto cloud = organisedCloud(8, 6);
  cloud.fields[3].offset = 13;
  EXPECT_FALSE(colourFromCloud(cloud));
  cloud.fields[3].offset = 0xffffffff;
  EXPECT_FALSE(colourFromCloud(cloud));
  cloud.fields.pop_back();
  EXPECT_FALSE(colourFromCloud(cloud));
}

TEST(Colour, encodings) {
  sensor_msgs::Image image;
  image.width = 2;
  image.height = 1;
  image.step = 6;
  image.encoding = "rgb8";
  image.data = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ((*colourFromImage(image))->image.pixel(1, 0), qRgb(4, 5, 6));
  image.encoding = "bgr8";
  EXPECT_EQ((*colourFromImage(image))->image.pixel(1, 0), qRgb(6, 5, 4));
  image.encoding = "mono8";
  EXPECT_EQ((*colourFromImage(image))->image.pixel(1, 0), qRgb(2, 2, 2));
  image.encoding = "yuv422";
  EXPECT_FALSE(colourFromImage(image));
  image.encoding = "rgba8";
  EXPECT_NE(colourFromImage(image).reason().find("step 6, expected at least 8"), std::string::npos);
  image.encoding = "rgb8";
  image.height = 2;
  EXPECT_FALSE(colourFromImage(image));
  image.width = image.height = image.step = 0xffffffff;
  EXPECT_FALSE(colourFromImage(image));
}

std::vector<std::uint8_t> jpegOfSize(int width, int height) {
  return {0xff,
          0xd8,
          0xff,
          0xe0,
          0x00,
          0x04,
          0x4a,
          0x46,
          0xff,
          0xc0,
          0x00,
          0x11,
          0x08,
          static_cast<std::uint8_t>(height >> 8),
          static_cast<std::uint8_t>(height & 255),
          static_cast<std::uint8_t>(width >> 8),
          static_cast<std::uint8_t>(width & 255),
          0x03,
          0x01,
          0x22,
          0x00,
          0x02,
          0x11,
          0x01,
          0x03,
          0x11,
          0x01};
}

TEST(Coded, sizeIsReadBeforeAnythingIsDecoded) {
  const auto size = codedSize(jpegOfSize(640, 480));
  ASSERT_TRUE(size) << size.reason();
  EXPECT_EQ(size->width, 640);
  EXPECT_EQ(size->height, 480);
  sensor_msgs::CompressedImage image;
  image.data = jpegOfSize(65000, 65000);
  EXPECT_NE(colourFromCompressed(image).reason().find("picture of 65000 x 65000"),
            std::string::npos);
  image.data = jpegOfSize(64, 48);  // right size, no content
  EXPECT_FALSE(colourFromCompressed(image));
  image.data = {};
  EXPECT_FALSE(colourFromCompressed(image));
  image.data.assign(100, 'x');
  EXPECT_EQ(colourFromCompressed(image).reason(), "neither a JPEG nor a PNG");
}

TEST(Coded, noPrefixOrMutationOfAHeaderCrashes) {
  std::mt19937 random(7);
  const auto whole = jpegOfSize(640, 480);
  for (std::size_t n = 0; n <= whole.size(); ++n)
    codedSize({whole.begin(), whole.begin() + static_cast<long>(n)});
  for (int i = 0; i < 20000; ++i) {
    auto bytes = whole;
    bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    codedSize(bytes);
  }
}

FloorGrid gridMessage() {
  FloorGrid grid;
  grid.info.width = 3;
  grid.info.height = 2;
  grid.info.resolution = 0.5F;
  grid.info.origin.position.x = 0.2;
  grid.info.origin.position.y = -0.5;
  grid.info.origin.orientation.w = 1.0;
  grid.classes = {0, 1, 2, 3, 4, 1};
  grid.heights.assign(6, 0.0F);
  grid.deviations.assign(6, 0.0F);
  grid.method = "improved";
  return grid;
}

TEST(Floor, pictureHasForwardUpAndLeftLeft) {
  const auto result = floorFromMessage(gridMessage());
  ASSERT_TRUE(result) << result.reason();
  const FloorPicture& picture = **result;
  EXPECT_EQ(picture.image.size(), QSize(2, 3));
  // Cell (ix 2, iy 0): farthest ahead, to the right.
  EXPECT_EQ(picture.image.pixel(1, 0), classColour(CellClass::kThreshold));
  // Cell (ix 0, iy 1): nearest, to the left.
  EXPECT_EQ(picture.image.pixel(0, 2), classColour(CellClass::kObstacle));
}

TEST(Floor, badGridsAreRefusedWithAReason) {
  const auto reason = [](void (*spoil)(FloorGrid&)) {
    auto grid = gridMessage();
    spoil(grid);
    const auto result = floorFromMessage(grid);
    return result ? std::string() : result.reason();
  };
  EXPECT_EQ(reason([](auto& g) { g.classes.pop_back(); }), "classes has 5 entries, expected 6");
  EXPECT_EQ(reason([](auto& g) { g.heights.clear(); }), "heights has 0 entries, expected 6");
  EXPECT_EQ(reason([](auto& g) { g.deviations.resize(7); }),
            "deviations has 7 entries, expected 6");
  EXPECT_NE(reason([](auto& g) { g.info.width = g.info.height = 0xffffffff; }), "");
  EXPECT_NE(reason([](auto& g) { g.info.width = 0; }), "");
  EXPECT_NE(reason([](auto& g) { g.info.resolution = NAN; }), "");
  EXPECT_NE(reason([](auto& g) { g.info.resolution = 0; }), "");
  EXPECT_NE(
      reason([](auto& g) { g.info.origin.position.x = std::numeric_limits<double>::infinity(); }),
      "");
  EXPECT_NE(reason([](auto& g) { g.info.origin.orientation.z = 0.7; }), "");
  EXPECT_EQ(reason([](auto& g) { g.classes[3] = 9; }), "class 9, expected 0 to 4");
}

// A list that nobody could draw many times a second is thinned, the gravest of each place stays.
TEST(Conversions, ofVeryManyObjectsThoseThatMatterAreDrawn) {
  ObjectList list;
  Object object;
  object.kind = Object::OBSTACLE;
  object.size = 0.01F;
  object.relevance = Object::OTHER;
  for (int i = 0; i < 200000; ++i) {
    object.position.x = static_cast<float>(i % 447) * 0.02F - 4.0F;
    object.position.y = static_cast<float>(i / 447) * 0.02F - 4.0F;
    list.objects.push_back(object);
  }
  list.objects[77777].relevance = Object::IN_THE_WAY;
  const auto picture = objectsFromMessage(list);
  ASSERT_TRUE(picture);
  const auto& drawn = (*picture)->objects;
  EXPECT_LE(drawn.size(), 5000U);
  EXPECT_GE(drawn.size(), 1000U);
  const auto red = std::find_if(drawn.begin(), drawn.end(),
                                [](const auto& mark) { return mark.relevance == InTheWay::kYes; });
  ASSERT_NE(red, drawn.end());
  EXPECT_EQ(red->x, list.objects[77777].position.x) << "it stays where it is";
  EXPECT_GT(red->size, 0.1F) << "and stands for its neighbours";
  list.objects.resize(5000);
  EXPECT_EQ((*objectsFromMessage(list))->objects.size(), 5000U) << "so many are drawn as they are";
}

TEST(Objects, badOnesAreRefused) {
  ObjectList list;
  list.objects.resize(1);
  list.objects[0].size = 0.05F;
  list.objects[0].kind = Object::OBSTACLE;
  EXPECT_TRUE(objectsFromMessage(list));
  list.objects[0].position.x = NAN;
  EXPECT_FALSE(objectsFromMessage(list));
  list.objects[0].position.x = 0;
  list.objects[0].kind = 77;
  EXPECT_FALSE(objectsFromMessage(list));
  list.objects[0].kind = Object::DROP_OFF;
  list.objects[0].size = -1;
  EXPECT_FALSE(objectsFromMessage(list));
}

/// What arrives when roscpp hands the bytes of a message to the console's helper.
template <class Message>
struct Arrival {
  boost::shared_ptr<const Message> message;
  std::string refused;

  explicit Arrival(std::vector<std::uint8_t> bytes) {
    const auto options = guardedOptions<Message>(
        "topic", 1, [](const ros::MessageEvent<const Message>&) {},
        [this](const std::string& reason) { refused = reason; });
    ros::SubscriptionCallbackHelperDeserializeParams params;
    params.buffer = bytes.data();
    params.length = static_cast<std::uint32_t>(bytes.size());
    message = boost::static_pointer_cast<const Message>(options.helper->deserialize(params));
  }
};

template <class Message>
std::vector<std::uint8_t> serialised(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

/// @param from_end where in the bytes the length begins.
std::vector<std::uint8_t> lying(std::vector<std::uint8_t> bytes, std::size_t from_end,
                                std::uint32_t claim) {
  std::memcpy(&bytes[bytes.size() - from_end], &claim, 4);
  return bytes;
}

TEST(Guard, letsAGoodFloorGridThroughAndRefusesOneThatLies) {
  const auto sent = gridMessage();
  const auto bytes = serialised(sent);
  const Arrival<FloorGrid> good(bytes);
  EXPECT_EQ(good.refused, "");
  ASSERT_TRUE(good.message);
  EXPECT_EQ(good.message->classes, sent.classes);
  EXPECT_EQ(good.message->method, sent.method);
  // From the end: method 4 + 8, deviations 4 + 24, heights 4 + 24, classes 4 + 6.
  const Arrival<FloorGrid> bad(lying(bytes, 78, 1500000000));
  EXPECT_EQ(bad.refused, "length of FloorGrid classes is 1500000000, expected 0 to 74");
  EXPECT_FALSE(bad.message);
}

TEST(Guard, letsAGoodObjectListThroughAndRefusesOneThatLies) {
  ObjectList sent;
  sent.source = "camera";
  sent.objects.resize(2);
  sent.objects[1].size = 0.05F;
  const auto bytes = serialised(sent);
  const Arrival<ObjectList> good(bytes);
  EXPECT_EQ(good.refused, "");
  ASSERT_TRUE(good.message);
  ASSERT_EQ(good.message->objects.size(), 2U);
  EXPECT_EQ(good.message->objects[1].size, 0.05F);
  const Arrival<ObjectList> bad(lying(bytes, 46, 80000000));
  EXPECT_EQ(bad.refused, "length of ObjectList objects is 80000000, expected 0 to 2");
  EXPECT_FALSE(bad.message);
}

TEST(Guard, refusesACloudThatLies) {
  const auto bytes = serialised(organisedCloud(8, 6));
  EXPECT_TRUE(Arrival<sensor_msgs::PointCloud2>(bytes).message);
  const Arrival<sensor_msgs::PointCloud2> bad(lying(bytes, 8 * 6 * 16 + 5, 0xffffffff));
  EXPECT_EQ(bad.refused, "length of PointCloud2 data is 4294967295, expected 0 to 769");
  EXPECT_FALSE(bad.message);
}

TEST(Diagnostics, complaintsComeAndGo) {
  DiagnosticsBoard board;
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(1);
  array.status[0].name = "floor: input";
  array.status[0].message = "2 rejected";
  array.status[0].level = diagnostic_msgs::DiagnosticStatus::WARN;
  board.update(array, 1.0);
  ASSERT_EQ(board.complaints(2.0).size(), 1U);
  EXPECT_EQ(board.complaints(2.0)[0].message, "2 rejected");
  EXPECT_TRUE(board.complaints(30.0).empty()) << "what nobody repeats is forgotten";
  array.status[0].level = diagnostic_msgs::DiagnosticStatus::OK;
  board.update(array, 2.0);
  EXPECT_TRUE(board.complaints(2.0).empty());
  array.status[0].level = diagnostic_msgs::DiagnosticStatus::ERROR;
  for (int i = 0; i < 300; ++i) {
    array.status[0].name = "job " + std::to_string(i);
    board.update(array, 3.0);
  }
  array.status[0].name = "motor";
  board.update(array, 20.0);
  ASSERT_EQ(board.complaints(20.0).size(), 1U) << "names of long ago leave room for new ones";
  EXPECT_EQ(board.complaints(20.0)[0].name, "motor");
}

}  // namespace
