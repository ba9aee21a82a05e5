// The guard that is made from a message's definition: what roscpp itself wrote passes, and whatever
// passes can be deserialised without an exception, however it was mutated.
#include "core/cloud/wire_schema.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <pilothouse/Operator.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>
#include <tf2_msgs/TFMessage.h>

#include <random>

#include "doors/guarded_subscriber.hpp"

namespace pilothouse {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class M>
Bytes written(const M& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

std::optional<LengthFault> fault(const WireSchema& schema, const Bytes& bytes) {
  return schema.fault(bytes.data(), bytes.size());
}

class Chance {
 public:
  explicit Chance(unsigned seed) : engine_(seed) {}
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(engine_);
  }
  std::string text() { return std::string(below(9), 'x'); }

 private:
  std::mt19937 engine_;
};

void fill(diagnostic_msgs::DiagnosticArray& m, Chance& c) {
  m.header.frame_id = c.text();
  m.status.resize(c.below(4));
  for (auto& status : m.status) {
    status.name = c.text();
    status.message = c.text();
    status.values.resize(c.below(4));
    for (auto& value : status.values) value.key = c.text(), value.value = c.text();
  }
}
void fill(nav_msgs::Path& m, Chance& c) {
  m.poses.resize(c.below(5));
  for (auto& pose : m.poses) pose.header.frame_id = c.text();
}
void fill(tf2_msgs::TFMessage& m, Chance& c) {
  m.transforms.resize(c.below(5));
  for (auto& t : m.transforms) t.header.frame_id = c.text(), t.child_frame_id = c.text();
}
void fill(dynamic_reconfigure::ConfigDescription& m, Chance& c) {
  m.groups.resize(c.below(3));
  for (auto& group : m.groups) {
    group.name = c.text();
    group.parameters.resize(c.below(3));
    for (auto& p : group.parameters) p.name = c.text(), p.edit_method = c.text();
  }
  m.max.bools.resize(c.below(3));
  m.min.strs.resize(c.below(3));
}
void fill(sensor_msgs::JointState& m, Chance& c) {
  m.name.resize(c.below(5));
  for (auto& name : m.name) name = c.text();
  m.velocity.resize(c.below(9));
}
void fill(nav_msgs::Odometry& m, Chance& c) {
  m.header.frame_id = c.text();
  m.child_frame_id = c.text();
}
void fill(rosgraph_msgs::Log& m, Chance& c) {
  m.msg = c.text();
  m.topics.resize(c.below(4));
  for (auto& topic : m.topics) topic = c.text();
}
void fill(SpeedLimit& m, Chance& c) {
  m.sensor = c.text();
  m.source = c.text();
}
void fill(StopState& m, Chance& c) {
  m.text = c.text();
  m.obstacle_to_arming = c.text();
}
void fill(Operator& m, Chance& c) {
  m.name = c.text();
}
void fill(geometry_msgs::TwistStamped& m, Chance& c) {
  m.header.frame_id = c.text();
}
void fill(sensor_msgs::Range& m, Chance& c) {
  m.header.frame_id = c.text();
}
// These have guards of their own; the definition must agree with them.
void fill(sensor_msgs::Image& m, Chance& c) {
  m.encoding = c.text();
  m.data.resize(c.below(50));
}
void fill(sensor_msgs::PointCloud2& m, Chance& c) {
  m.fields.resize(c.below(5));
  for (auto& field : m.fields) field.name = c.text();
  m.data.resize(c.below(50));
}
void fill(sensor_msgs::CameraInfo& m, Chance& c) {
  m.D.resize(c.below(8));
}
void fill(FloorGrid& m, Chance& c) {
  m.classes.resize(c.below(9));
  m.heights.resize(c.below(9));
  m.method = c.text();
}
void fill(ObjectList& m, Chance& c) {
  m.sources.resize(c.below(4));
  for (auto& source : m.sources) source.name = c.text();
  m.objects.resize(c.below(9));
}

template <class M>
class WireSchemaOf : public testing::Test {};
using Messages =
    testing::Types<diagnostic_msgs::DiagnosticArray, nav_msgs::Path, tf2_msgs::TFMessage,
                   dynamic_reconfigure::ConfigDescription, sensor_msgs::JointState,
                   nav_msgs::Odometry, rosgraph_msgs::Log, SpeedLimit, StopState, Operator,
                   geometry_msgs::TwistStamped, sensor_msgs::Range, sensor_msgs::Image,
                   sensor_msgs::PointCloud2, sensor_msgs::CameraInfo, FloorGrid, ObjectList>;
TYPED_TEST_SUITE(WireSchemaOf, Messages);

TYPED_TEST(WireSchemaOf, PassesWhatRoscppWrote) {
  Chance chance(1);
  for (int i = 0; i < 300; ++i) {
    TypeParam message;
    fill(message, chance);
    const Bytes bytes = written(message);
    const auto found = fault(wireSchemaOf<TypeParam>(), bytes);
    ASSERT_FALSE(found) << describe(*found);
    ASSERT_FALSE(lengthFault<TypeParam>(bytes.data(), bytes.size()));
  }
}

TYPED_TEST(WireSchemaOf, RefusesEveryTruncationAndExtension) {
  Chance chance(2);
  TypeParam message;
  fill(message, chance);
  Bytes bytes = written(message);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
    ASSERT_TRUE(fault(wireSchemaOf<TypeParam>(), cut)) << n << " of " << bytes.size() << " bytes";
  }
  bytes.push_back(0);
  EXPECT_TRUE(fault(wireSchemaOf<TypeParam>(), bytes));
}

TYPED_TEST(WireSchemaOf, WhatItPassesIsDeserialisedToTheLastByte) {
  Chance chance(3);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    TypeParam message;
    fill(message, chance);
    Bytes bytes = written(message);
    const std::uint32_t values[] = {0, 1, 7, 0x100, 0x10000, 40000000, 0x7FFFFFFF, 0xFFFFFFFF};
    const std::uint32_t value = values[chance.below(std::size(values))];
    std::memcpy(&bytes[chance.below(bytes.size() - 3)], &value, sizeof value);
    if (fault(wireSchemaOf<TypeParam>(), bytes)) {
      ++refused;
      continue;
    }
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    TypeParam read;
    ASSERT_NO_THROW(ros::serialization::deserialize(stream, read));
    ASSERT_EQ(stream.getLength(), 0U);
  }
  EXPECT_GT(refused, 0);  // every type here has a length somewhere
}

WireSchema parsed(const std::string& definition) {
  const auto schema = WireSchema::parse("p/A", definition);
  EXPECT_TRUE(schema) << schema.reason();
  return *schema;
}

std::string refusal(const std::string& definition) {
  return WireSchema::parse("p/A", definition).reason();
}

const std::string kLine(80, '=');

TEST(WireSchema, ReadsConstantsCommentsAndOwnPackage) {
  const WireSchema schema =
      parsed("# a comment\nint8 X=3\nstring S= a # b = c \n  B[] list # [3]\n" + kLine +
             "\nMSG: p/B\nfloat64[2] pair\nbyte b\n");
  EXPECT_EQ(schema.types().back().fields.size(), 1U);
  EXPECT_EQ(schema.types().back().fields[0].size, 17U);
  EXPECT_FALSE(fault(schema, Bytes{2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                   0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(WireSchema, NamesTheLengthThatLies) {
  const WireSchema schema = parsed("string[] words\n");
  EXPECT_EQ(describe(*fault(schema, Bytes{0, 1, 0, 0, 0})),
            "length of p/A words is 256, expected 0 to 0");
}

TEST(WireSchema, BoundsTextsAndWhatTakesNoBytes) {
  Bytes text(4 + 70000, 'x');
  const std::uint32_t length = 70000;
  std::memcpy(text.data(), &length, 4);
  EXPECT_TRUE(fault(parsed("string s\n"), text));
  EXPECT_TRUE(fault(parsed("B[] nothing\n" + kLine + "\nMSG: p/B\n"), Bytes{0, 0, 0, 0x7F}));
}

TEST(WireSchema, RefusesDefinitionsThatMakeNoSense) {
  EXPECT_NE(refusal("B b\n").find("p/B is not defined"), std::string::npos);
  EXPECT_NE(refusal("A[] a\n").find("made of itself"), std::string::npos);
  EXPECT_NE(refusal("int8\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("int8[x] y\n").find("length"), std::string::npos);
  EXPECT_NE(refusal("int8[ y\n").find("length"), std::string::npos);
  EXPECT_NE(refusal("int8 a\n" + kLine + "\nnonsense\n").find("line 3"), std::string::npos);
  EXPECT_NE(refusal("float64[999999999] a\nA9[999999999] b\n" + kLine +
                    "\nMSG: p/A9\nfloat64[999999999] a\n")
                .find("too long"),
            std::string::npos);
}

}  // namespace
}  // namespace pilothouse
