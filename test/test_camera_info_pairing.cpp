#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include "nodelets/camera_info_pairing.hpp"

namespace pilothouse {
namespace {

sensor_msgs::Image::Ptr image(double stamp, std::uint32_t width = 640) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = ros::Time(stamp);
  message->header.frame_id = "camera";
  message->width = width;
  message->height = 480;
  return message;
}

sensor_msgs::CameraInfo::Ptr info(double stamp, std::uint32_t width = 640) {
  auto message = boost::make_shared<sensor_msgs::CameraInfo>();
  message->header = image(stamp)->header;
  message->width = width;
  message->height = 480;
  return message;
}

class Pairing : public testing::Test {
 protected:
  struct Pair {
    double image, info;
    bool operator==(const Pair& other) const { return image == other.image && info == other.info; }
  };
  CameraInfoPairing pairing_{
      [this](const auto& i, const auto& c) {
        pairs_.push_back({i->header.stamp.toSec(), c->header.stamp.toSec()});
      },
      [this](const auto& i) { unpaired_.push_back(i->header.stamp.toSec()); }};
  std::vector<Pair> pairs_;
  std::vector<double> unpaired_;
};

TEST_F(Pairing, TakesTheInfoOfTheSameStamp) {
  pairing_.add(info(1.0));
  pairing_.add(info(2.0));
  pairing_.add(image(1.0));
  EXPECT_EQ(pairs_, (std::vector<Pair>{{1.0, 1.0}}));
}

TEST_F(Pairing, ElseTheNewestOfTheSameSizeAndFrame) {
  pairing_.add(info(1.0));
  pairing_.add(info(2.0));
  pairing_.add(info(3.0, 320));
  pairing_.add(image(2.5));
  EXPECT_EQ(pairs_, (std::vector<Pair>{{2.5, 2.0}}));
}

TEST_F(Pairing, NeverAnotherCamerasInfo) {
  const auto other = info(1.0);
  other->header.frame_id = "other";
  pairing_.add(other);
  pairing_.add(image(1.5));
  EXPECT_TRUE(pairs_.empty());
}

TEST_F(Pairing, AnImageBeforeItsInfoWaitsForIt) {
  pairing_.add(image(1.0));
  EXPECT_TRUE(pairs_.empty());
  pairing_.add(info(1.0));
  EXPECT_EQ(pairs_, (std::vector<Pair>{{1.0, 1.0}}));
  EXPECT_TRUE(unpaired_.empty());
}

TEST_F(Pairing, AnImageThatNoInfoComesForIsReportedWhenTheNextArrives) {
  pairing_.add(image(1.0));
  pairing_.add(image(2.0));
  EXPECT_EQ(unpaired_, std::vector<double>{1.0});
  pairing_.add(info(2.0));
  EXPECT_EQ(pairs_, (std::vector<Pair>{{2.0, 2.0}}));
}

TEST_F(Pairing, ForgetsWhenCleared) {
  pairing_.add(info(1.0));
  pairing_.clear();
  pairing_.add(image(1.0));
  EXPECT_TRUE(pairs_.empty());
}

}  // namespace
}  // namespace pilothouse
