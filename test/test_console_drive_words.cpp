// The words for every cause, what is refused of the driving messages, and the way ahead.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "gui/model/conversions_drive.hpp"
#include "gui/model/drive_words.hpp"
#include "gui/model/swept_outline.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

LimitReading limitOf(LimitCause cause) {
  LimitReading limit;
  limit.cause = cause;
  limit.sensor = "camera";
  limit.source = "teleop";
  limit.limit = limit.limited = 0.18;
  limit.wanted = 0.4;
  limit.distance = 0.62;
  return limit;
}

TEST(Words, everyCauseOfALimit) {
  const auto words = [](LimitCause cause) { return limitWords(limitOf(cause)); };
  EXPECT_EQ(words(LimitCause::kObstacle), "Slowed to 0.18 m/s: camera sees something 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kPotential),
            "Slowed to 0.18 m/s: camera sees something beside the way 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kBraking), "Braking: camera sees something 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kThreshold), "Slowed to 0.18 m/s: a threshold 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kUnseen), "Slowed to 0.18 m/s: nothing has looked there");
  EXPECT_EQ(words(LimitCause::kBadCommand), "Stopped: the wanted command is not finite");
  auto stale = limitOf(LimitCause::kStale);
  EXPECT_EQ(limitWords(stale), "Stopped: nothing from camera yet");
  stale.input_age = 0.42;
  EXPECT_EQ(limitWords(stale), "Stopped: camera silent for 0.4 s");
  auto held = limitOf(LimitCause::kObstacle);
  held.limit = 0.0;
  held.sensor = "memory";
  held.x = -1.0;
  held.y = 0.3;
  EXPECT_EQ(limitWords(held), "Held at 0 m/s: something remembered 0.62 m behind");
  held.y = 1.3;
  EXPECT_EQ(limitWords(held), "Held at 0 m/s: something remembered 0.62 m to the left");
  auto passing = limitOf(LimitCause::kPotential);
  passing.distance = 0.0;
  passing.x = 0.1;
  passing.y = -0.4;
  EXPECT_EQ(limitWords(passing), "Slowed to 0.18 m/s: camera sees something close by on the right");
}

DriveSituation ready() {
  DriveSituation s;
  s.connected = true;
  s.now = 10.0;
  s.limit_state.ever = s.stop_state.ever = true;
  s.stop.phase = GatePhase::kRunning;
  s.limit = limitOf(LimitCause::kFree);
  return s;
}

TEST(Words, tellWhatHoldsTheRobotAndWhatToDo) {
  auto s = ready();
  EXPECT_EQ(driveWords(s).headline, "Driving by hand at 0.18 m/s");
  s.limit.wanted = 0.0;
  EXPECT_EQ(driveWords(s).headline, "Ready: nobody drives");
  s.limit = limitOf(LimitCause::kObstacle);
  EXPECT_EQ(driveWords(s).severity, Severity::kWarning);
  EXPECT_FALSE(driveWords(s).advice.empty());

  s.stop.phase = GatePhase::kStopped;
  s.stop.cause = StopCause::kOperator;
  s.stop.can_arm = true;
  EXPECT_EQ(driveWords(s).headline, "Stopped: operator's stop");
  EXPECT_EQ(driveWords(s).advice, "Hold Arm (F9) for a second to go on");
  s.stop.can_arm = false;
  s.stop.obstacle_to_arming = "odometry is 0.41 s old, limit 0.30 s";
  EXPECT_EQ(driveWords(s).advice, "Before arming: odometry is 0.41 s old, limit 0.30 s");
  s.stop.text = "perception is 0.40 s old";
  EXPECT_EQ(driveWords(s).headline, "Stopped: perception is 0.40 s old");

  s.stop_state.age_s = 3.0;
  EXPECT_EQ(driveWords(s).headline, "Stop gate silent for 3.0 s");
  s.stop_state.ever = false;
  EXPECT_EQ(driveWords(s).headline, "No stop gate: nothing can be driven from here");
  s.connected = false;
  EXPECT_EQ(driveWords(s).headline, "No robot: no ROS master answers");
}

TEST(Words, aStopThatNobodyConfirmsIsNeverShownAsDone) {
  auto s = ready();
  s.helm.stop = true;
  EXPECT_EQ(driveWords(s).headline, "Stop pressed, not confirmed by the gate yet");
  s.stop_state.ever = false;
  EXPECT_EQ(driveWords(s).headline, "Stop pressed, but no stop gate has answered yet");
}

TEST(Words, withoutAMasterTheGateStillSaysWhatHoldsTheRobot) {
  auto s = ready();
  s.connected = false;
  EXPECT_EQ(driveWords(s).headline, "Driving by hand at 0.18 m/s");
  EXPECT_EQ(driveWords(s).severity, Severity::kWarning);
  EXPECT_NE(driveWords(s).advice.find("The ROS master is lost"), std::string::npos);
  s.helm.stop = true;
  EXPECT_EQ(driveWords(s).headline, "Stop pressed, not confirmed by the gate yet");
  s.stop_state.age_s = 3.0;
  EXPECT_EQ(driveWords(s).headline, "Stop pressed, but the stop gate is silent for 3.0 s");
  s.helm.stop = false;
  EXPECT_EQ(driveWords(s).headline, "No robot: no ROS master answers");
}

TEST(Words, ofALostMasterKeepWhatIsWrongWithTheStreams) {
  Situation situation;
  situation.now = 30.0;
  situation.link.phase = LinkPhase::kLost;
  situation.complaints.push_back({"motor driver", "overheated", true});
  ExpectedStream depth{"depth", "depth", false, true, {}};
  situation.streams.push_back(depth);
  depth.state.ever = true;
  depth.state.age_s = 7.0;
  situation.streams.push_back(depth);
  const auto all = notices(situation);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].text.find("lost the master"), 0U);
  EXPECT_EQ(all[1].text, "no depth for 7 s on depth");
  EXPECT_EQ(all[2].text, "motor driver: overheated");
}

TEST(Words, aMasterThatHangsIsLost) {
  LinkStatus link;
  link.phase = LinkPhase::kConnected;
  link.looked_at = 100.0;
  EXPECT_EQ(linkAt(link, 101.0).phase, LinkPhase::kConnected);
  EXPECT_EQ(linkAt(link, 110.0).phase, LinkPhase::kLost);
  EXPECT_EQ(linkAt(link, 110.0).since, 100.0);
}

TEST(Words, everyCauseOfAStopHasWords) {
  std::set<std::string> all;
  for (int cause = 0; cause <= 10; ++cause) {
    StopReading stop;
    stop.cause = static_cast<StopCause>(cause);
    stop.perception_age = stop.odometry_age = 0.4;
    all.insert(stopWords(stop));
  }
  EXPECT_EQ(all.size(), 11U);
  StopReading silent;
  silent.cause = StopCause::kStalePerception;
  silent.perception_age = 0.4;
  EXPECT_EQ(stopWords(silent), "Stopped: camera silent for 0.4 s");
}

TEST(Conversions, refuseWhatCannotBeDrawn) {
  SpeedLimit limit;
  limit.measured = NAN;
  limit.obstacle_distance = limit.potential_distance = INFINITY;
  EXPECT_TRUE(limitFromMessage(limit));
  limit.cause = 8;
  EXPECT_EQ(limitFromMessage(limit).reason(), "cause 8, expected 0 to 7");
  limit.cause = 0;
  limit.wanted = NAN;
  EXPECT_FALSE(limitFromMessage(limit));
  limit.wanted = 0.0F;
  limit.position.x = INFINITY;
  EXPECT_FALSE(limitFromMessage(limit));

  StopState stop;
  stop.text = "a\nb" + std::string(1000, 'x');
  ASSERT_TRUE(stopFromMessage(stop));
  EXPECT_EQ(stopFromMessage(stop)->text.size(), 160U);
  EXPECT_EQ(stopFromMessage(stop)->text.find('\n'), std::string::npos);
  stop.state = 3;
  EXPECT_FALSE(stopFromMessage(stop));
  stop.state = 0;
  stop.command.linear.x = NAN;
  EXPECT_FALSE(stopFromMessage(stop));

  sensor_msgs::JointState joints;
  joints.name = {"front_left_wheel", "front_left_steering", "_wheel"};
  EXPECT_FALSE(wheelsFromMessage(joints)) << "no velocities";
  joints.velocity = {NAN, 1.0, 2.0};
  ASSERT_TRUE(wheelsFromMessage(joints));
  ASSERT_EQ(wheelsFromMessage(joints)->size(), 1U);
  EXPECT_TRUE(std::isnan((*wheelsFromMessage(joints))[0].rate));
  joints.name.assign(65, "a_wheel");
  joints.velocity.assign(65, 0.0);
  EXPECT_FALSE(wheelsFromMessage(joints));

  sensor_msgs::Range range;
  range.max_range = 3.0F;
  range.field_of_view = 0.5F;
  range.range = 4.0F;
  EXPECT_TRUE(std::isinf(rangeFromMessage(range)->range));
  range.field_of_view = 1e9F;
  EXPECT_FALSE(rangeFromMessage(range));
}

TEST(SweptOutline, endsWhereTheFootprintIsAfterThatWay) {
  const Footprint footprint({{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}});
  const SweptOutline straight = sweptOutline(footprint, {0.4, 0.0, 0.0}, 2.0);
  ASSERT_GE(straight.left.size(), 2U);
  EXPECT_NEAR(straight.left.back().x(), 2.25, 1e-6);
  EXPECT_NEAR(straight.left.back().y(), 0.2, 1e-6);
  EXPECT_NEAR(straight.right.back().x(), 2.25, 1e-6);
  EXPECT_TRUE(sweptOutline(footprint, {}, 2.0).outlines.empty());
  EXPECT_TRUE(sweptOutline(footprint, {NAN, 0.0, 0.0}, 2.0).outlines.empty());
  for (const auto& outline : sweptOutline(footprint, {0.0, 0.0, 1.0}, 50.0).outlines) {
    for (const auto& p : outline) EXPECT_LT(p.norm(), 0.33) << "turning in place stays in place";
  }
}

}  // namespace
