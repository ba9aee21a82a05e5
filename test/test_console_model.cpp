// The console's logic without widgets: meters, colours, map transform, status sentences.

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "gui/model/class_colours.hpp"
#include "gui/model/console_state.hpp"
#include "gui/model/depth_ramp.hpp"
#include "gui/model/feed.hpp"
#include "gui/model/map_view.hpp"
#include "gui/model/situation.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

FeedMeter meterAt(double hertz, int count) {
  FeedMeter meter;
  for (int i = 0; i < count; ++i) {
    const double t = 100.0 + i / hertz;
    meter.arrived(t, static_cast<std::uint32_t>(i), "/camera", "/depth");
    meter.accepted(t, 0.0);
  }
  return meter;
}

TEST(FeedMeter, tellsTheRate) {
  EXPECT_NEAR(meterAt(30.0, 200).state(100.0 + 199 / 30.0).rate_hz, 30.0, 0.01);
  EXPECT_NEAR(meterAt(1.0, 20).state(119.2).rate_hz, 1.0, 0.01);
  EXPECT_EQ(meterAt(30.0, 1).state(100.0).rate_hz, 0.0);
}

TEST(FeedMeter, tellsNoRateWhenNothingCameForLong) {
  EXPECT_EQ(meterAt(30.0, 200).state(200.0).rate_hz, 0.0);
}

TEST(FeedMeter, ageGrowsAndBeginsWithTheLatency) {
  FeedMeter meter;
  meter.arrived(10.0, 1, "a", "t");
  meter.accepted(10.0, 0.25);
  EXPECT_NEAR(meter.state(10.0).age_s, 0.25, 1e-9);
  EXPECT_NEAR(meter.state(12.0).age_s, 2.25, 1e-9);
}

TEST(FeedMeter, countsGapsOfOnePublisherOnly) {
  FeedMeter meter;
  meter.arrived(1.0, 5, "a", "t");
  meter.arrived(1.1, 8, "a", "t");  // 6 and 7 are lost
  EXPECT_EQ(meter.state(1.2).drops, 2U);
  meter.arrived(1.2, 900, "b", "t");  // another publisher counts for itself
  meter.arrived(1.3, 2, "b", "t");    // a bag that begins again is no loss
  EXPECT_EQ(meter.state(1.4).drops, 2U);
  meter.overwritten();
  EXPECT_EQ(meter.state(1.4).drops, 3U);
}

TEST(FeedMeter, rejectionShowsUntilAcceptedOrOld) {
  FeedMeter meter;
  meter.rejected(10.0, "step 3, expected 1280");
  EXPECT_EQ(meter.state(10.1).rejection, "step 3, expected 1280");
  EXPECT_EQ(meter.state(10.1).rejected, 1U);
  EXPECT_EQ(meter.state(20.0).rejection, "");
  meter.rejected(20.0, "again");
  meter.accepted(20.1, 0.0);
  EXPECT_EQ(meter.state(20.1).rejection, "");
}

TEST(Freshness, lateThenStale) {
  const FeedMeter meter = meterAt(10.0, 50);
  const double last = 100.0 + 4.9;
  EXPECT_EQ(freshness(FeedMeter().state(0.0)), Freshness::kNever);
  EXPECT_EQ(freshness(meter.state(last + 0.1)), Freshness::kFresh);
  EXPECT_EQ(freshness(meter.state(last + 1.0)), Freshness::kLate);
  EXPECT_EQ(freshness(meter.state(last + 3.1)), Freshness::kStale);
  // A camera of one picture a second is not late between two pictures.
  EXPECT_EQ(freshness(meterAt(1.0, 10).state(110.2)), Freshness::kFresh);
}

TEST(Feed, keepsTheNewestAndCountsWhatNobodyDrew) {
  Feed<int> feed;
  using Result = Checked<std::shared_ptr<const int>>;
  feed.deliver(Result::of(std::make_shared<const int>(1)), 1.0, 0.0);
  feed.deliver(Result::of(std::make_shared<const int>(2)), 1.1, 0.0);
  EXPECT_EQ(feed.state(1.2).drops, 1U);
  ASSERT_TRUE(feed.take(1.2));
  EXPECT_FALSE(feed.take(1.3)) << "the same picture must not be drawn twice";
  EXPECT_EQ(*feed.latest(), 2);
  feed.deliver(Result::refused("bad"), 1.3, 0.0);
  EXPECT_EQ(feed.state(1.3).rejection, "bad");
  EXPECT_EQ(*feed.latest(), 2) << "a refused message leaves the last good picture";
}

TEST(Pace, drawsAJitteringCameraOf30HertzAndNoMore) {
  Pace pace;
  int drawn = 0;
  for (int i = 0; i < 300; ++i) drawn += pace.due(100.0 + i / 30.0 + (i % 2) * 0.012) ? 1 : 0;
  EXPECT_EQ(drawn, 300);
  drawn = 0;
  for (int i = 0; i < 1000; ++i) drawn += pace.due(200.0 + i / 100.0) ? 1 : 0;
  EXPECT_NEAR(drawn, 303, 3) << "ten seconds of a camera of 100 Hz";
}

TEST(Mailbox, overwritesAndSaysSo) {
  Mailbox<int> box;
  EXPECT_FALSE(box.put({boost::shared_ptr<const int>(new int(1)), 0.0, 0.0, "t"}));
  EXPECT_TRUE(box.put({boost::shared_ptr<const int>(new int(2)), 0.0, 0.0, "t"}));
  EXPECT_EQ(*box.take().message, 2);
  EXPECT_FALSE(box.take().message);
}

TEST(DepthRamp, readsBackToMetres) {
  const DepthRamp ramp;
  const DepthSpan span{0.5F, 5.0F};
  for (float metres = 0.5F; metres <= 5.0F; metres += 0.013F) {
    EXPECT_NEAR(ramp.metres(ramp.colour(metres, span), span), metres, 4.5F / 255.0F);
  }
  EXPECT_EQ(ramp.metres(ramp.colour(0.0F, span), span), 0.0F);
  EXPECT_EQ(ramp.colour(NAN, span), DepthRamp::nothing());
  EXPECT_EQ(ramp.colour(-1.0F, span), DepthRamp::nothing());
  EXPECT_EQ(ramp.colour(1e30F, span), ramp.colour(5.0F, span));
  EXPECT_EQ(ramp.colour(0.01F, span), ramp.colour(0.5F, span));
}

TEST(DepthRamp, getsDarkerWithDistance) {
  const DepthRamp ramp;
  int last = 256 * 1000;
  for (int i = 0; i <= 16; ++i) {
    const QRgb c = ramp.colour(1.0F + static_cast<float>(i) * 0.25F, {1.0F, 5.0F});
    const int luma = 299 * qRed(c) + 587 * qGreen(c) + 114 * qBlue(c);
    EXPECT_LT(luma, last);
    last = luma;
  }
}

TEST(DepthSpanChooser, widensAtOnceAndNarrowsLate) {
  DepthSpanChooser chooser;
  const std::vector<float> near(1000, 1.4F);
  const std::vector<float> far(1000, 3.4F);
  EXPECT_FLOAT_EQ(chooser.update(near).far_m, 1.5F);
  EXPECT_FLOAT_EQ(chooser.update(far).far_m, 4.0F);
  EXPECT_FLOAT_EQ(chooser.update(near).far_m, 4.0F);
  for (int i = 0; i < 60; ++i) chooser.update(near);
  EXPECT_FLOAT_EQ(chooser.update(near).far_m, 1.5F);
  EXPECT_FLOAT_EQ(chooser.update(std::vector<float>(1000, 0.0F)).far_m, 1.5F);
}

TEST(MapView, pixelsAndMetresAreInverse) {
  MapView view;
  view.resize({800, 600});
  view.fit({0.0, -2.5, 4.0, 5.0}, {10, 20}, {30, 40});
  for (double x = -3.0; x < 7.0; x += 0.7) {
    for (double y = -4.0; y < 4.0; y += 0.9) {
      const QPointF back = view.toMetres(view.toPixel(x, y));
      EXPECT_NEAR(back.x(), x, 1e-9);
      EXPECT_NEAR(back.y(), y, 1e-9);
    }
  }
}

TEST(MapView, forwardIsUpAndLeftIsLeft) {
  MapView view;
  view.resize({800, 600});
  EXPECT_LT(view.toPixel(1, 0).y(), view.toPixel(0, 0).y());
  EXPECT_LT(view.toPixel(0, 1).x(), view.toPixel(0, 0).x());
}

TEST(MapView, fitShowsAllWithinTheMargins) {
  MapView view;
  view.resize({800, 600});
  view.fit({0.0, -2.5, 4.0, 5.0}, {10, 20}, {30, 40});
  const QPointF left_top = view.toPixel(4.0, 2.5);
  const QPointF right_bottom = view.toPixel(0.0, -2.5);
  EXPECT_GE(left_top.x(), 10 - 1e-6);
  EXPECT_GE(left_top.y(), 20 - 1e-6);
  EXPECT_LE(right_bottom.x(), 770 + 1e-6);
  EXPECT_LE(right_bottom.y(), 560 + 1e-6);
  EXPECT_NEAR(left_top.y(), 20, 1e-6) << "the tighter side is filled";
}

TEST(MapView, zoomKeepsThePlaceUnderTheCursor) {
  MapView view;
  view.resize({800, 600});
  const QPointF cursor(123, 456);
  const QPointF before = view.toMetres(cursor);
  view.zoomAbout(cursor, 3.7);
  EXPECT_NEAR(view.toMetres(cursor).x(), before.x(), 1e-9);
  EXPECT_NEAR(view.toMetres(cursor).y(), before.y(), 1e-9);
  view.zoomAbout(cursor, 1e9);
  EXPECT_DOUBLE_EQ(view.scale(), MapView::kMostScale);
  view.zoomAbout(cursor, NAN);
  EXPECT_DOUBLE_EQ(view.scale(), MapView::kMostScale);
}

TEST(MapView, dragMovesTheContentWithThePointer) {
  MapView view;
  view.resize({800, 600});
  const QPointF before = view.toPixel(1.0, 0.5);
  view.panBy({30, -12});
  EXPECT_NEAR(view.toPixel(1.0, 0.5).x(), before.x() + 30, 1e-9);
  EXPECT_NEAR(view.toPixel(1.0, 0.5).y(), before.y() - 12, 1e-9);
}

TEST(RoundLength, isRoundAndLongEnough) {
  EXPECT_DOUBLE_EQ(roundLength(60, 100), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(60, 130), 0.5);
  EXPECT_DOUBLE_EQ(roundLength(60, 31), 2.0);
}

// As a dichromat sees a colour (Vienot, Brettel and Mollon 1999 for red and green; Machado et al.
// 2009, severity 1, for blue), in linear light.
struct Linear {
  double r, g, b;
};
double linear(int c) {
  return std::pow(c / 255.0, 2.2);
}
Linear seen(QRgb c, int kind) {
  static const double m[4][9] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                 {0.11238, 0.88762, 0, 0.11238, 0.88762, 0, 0.00401, -0.00401, 1},
                                 {0.29275, 0.70725, 0, 0.29275, 0.70725, 0, -0.02234, 0.02234, 1},
                                 {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602,
                                  0.004733, 0.691367, 0.303900}};
  const double r = linear(qRed(c)), g = linear(qGreen(c)), b = linear(qBlue(c));
  const double* k = m[kind];
  return {k[0] * r + k[1] * g + k[2] * b, k[3] * r + k[4] * g + k[5] * b,
          k[6] * r + k[7] * g + k[8] * b};
}
// Difference in CIE L*a*b* (1976).
double difference(Linear p, Linear q) {
  const auto lab = [](Linear c) {
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
    const double x = f((0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b) / 0.9505);
    const double y = f(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
    const double z = f((0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b) / 1.089);
    return Linear{116 * y - 16, 500 * (x - y), 200 * (y - z)};
  };
  const Linear a = lab(p), b = lab(q);
  return std::hypot(a.r - b.r, a.g - b.g, a.b - b.b);
}

TEST(ClassColours, stayApartForEveryEye) {
  const QRgb background = qRgb(0x12, 0x15, 0x19);
  const QRgb colours[] = {background, classColour(CellClass::kFloor),
                          classColour(CellClass::kThreshold), classColour(CellClass::kObstacle),
                          classColour(CellClass::kDropOff)};
  for (int kind = 0; kind < 4; ++kind) {
    for (int i = 0; i < 5; ++i) {
      for (int j = i + 1; j < 5; ++j) {
        EXPECT_GT(difference(seen(colours[i], kind), seen(colours[j], kind)), 22.0)
            << "classes " << i << " and " << j << " for eye " << kind;
      }
    }
  }
}

Situation connected() {
  Situation s;
  s.now = 50.0;
  s.link.phase = LinkPhase::kConnected;
  s.link.master_uri = "http://localhost:11311";
  s.link.since = 10.0;
  s.robot = "platform";
  ExpectedStream depth;
  depth.what = "depth";
  depth.topic = "camera/depth/image_rect";
  depth.advertised = true;
  depth.state.ever = true;
  depth.state.rate_hz = 30.0;
  s.streams.push_back(depth);
  return s;
}

TEST(Notices, oneGoodSentenceWhenAllIsWell) {
  const auto all = notices(connected());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].severity, Severity::kGood);
}

TEST(Notices, sayWhatIsMissing) {
  Situation s = connected();
  s.streams[0].state.age_s = 3.4;
  EXPECT_EQ(notices(s)[0].text, "no depth for 3 s on camera/depth/image_rect");
  EXPECT_EQ(notices(s)[0].severity, Severity::kError);
  s.streams[0].state.ever = false;
  EXPECT_EQ(notices(s)[0].text, "no depth yet on camera/depth/image_rect");
  s.streams[0].advertised = false;
  EXPECT_EQ(notices(s)[0].text, "no depth: nobody publishes camera/depth/image_rect");
  s.link.phase = LinkPhase::kNoMaster;
  ASSERT_EQ(notices(s).size(), 1U) << "without a master nothing else can be said";
  EXPECT_EQ(notices(s)[0].text, "no master at http://localhost:11311: waiting");
  s.link.phase = LinkPhase::kLost;
  EXPECT_EQ(notices(s)[0].text, "lost the master at http://localhost:11311 40 s ago: reconnecting");
}

TEST(Notices, worstComesFirst) {
  Situation s = connected();
  s.missing_transform = "base_link to camera";
  s.complaints = {{"floor", "2 inputs rejected", false}, {"gate", "stopped", true}};
  s.link.robot = "docker";
  const auto all = notices(s);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].text, "gate: stopped");
  EXPECT_EQ(all[1].text, "no transform from base_link to camera");
  EXPECT_EQ(all[2].text, "floor: 2 inputs rejected");
  EXPECT_EQ(all[3].text, "the running robot is docker, this console draws platform");
}

TEST(Notices, rejectedInputsAreNamed) {
  Situation s = connected();
  s.streams[0].state.rejection = "step 3, expected 1280";
  EXPECT_EQ(notices(s)[0].text, "depth rejected: step 3, expected 1280");
}

TEST(SituationOf, namesAMissingGateAndBaseOnlyWhereSomethingCanDrive) {
  ConsoleState state;
  LinkStatus link;
  link.phase = LinkPhase::kConnected;
  state.link.set(link);
  state.names.set(
      {{"speed_limit", "/speed_limit"}, {"stop_state", "/stop_state"}, {"odom", "/odom"}});
  const auto says = [&](const std::string& text) {
    for (const auto& notice : notices(situationOf(state, "platform", 10.0))) {
      if (notice.text.find(text) != std::string::npos) return true;
    }
    return false;
  };
  EXPECT_FALSE(says("stop gate"));
  EXPECT_FALSE(says("base"));
  state.advertised.set({"/speed_limit"});
  EXPECT_TRUE(says("no stop gate: nobody publishes stop_state"));
  EXPECT_TRUE(says("base: nobody publishes odom: is it or its simulator on?"));
  state.advertised.set({"/speed_limit", "/stop_state", "/odom"});
  EXPECT_FALSE(says("nobody publishes odom"));
  RouteReading route;
  route.phase = RoutePhase::kDriving;
  route.target = 1;
  route.points = 5;
  route.distance_left = 3.14;
  route.at = 9.0;
  state.route.set(route);
  EXPECT_TRUE(says("route: to point 2 of 5, 3.1 m left"));
  ContactsReading contacts;
  contacts.count = 2;
  contacts.at = 9.0;
  state.contacts.set(contacts);
  EXPECT_TRUE(says("contacts: 2 since the start"));
}

TEST(SituationOf, namesRemappedTopicsAndNeedsNoTransformWhileTheFloorArrives) {
  ConsoleState state;
  LinkStatus link;
  link.phase = LinkPhase::kConnected;
  state.link.set(link);
  state.names.set({{"camera/depth/image_rect", "/d435/depth"}, {"floor_grid", "/floor_grid"}});
  state.missing_transform.set("base_link to camera");
  const auto text = [&](double now) {
    std::string all;
    for (const auto& notice : notices(situationOf(state, "platform", now)))
      all += notice.text + "\n";
    return all;
  };
  EXPECT_NE(text(5.0).find("nobody publishes /d435/depth"), std::string::npos);
  EXPECT_NE(text(5.0).find("no transform from base_link to camera"), std::string::npos);
  state.floor.arrived(5.0, 1, "floor", "/floor_grid");
  state.floor.deliver(
      Checked<std::shared_ptr<const FloorPicture>>::of(std::make_shared<const FloorPicture>()), 5.0,
      0.0);
  EXPECT_EQ(text(5.1).find("no transform"), std::string::npos);
}

}  // namespace
