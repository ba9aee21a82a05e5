// The console's side of maps, goals, routes and poses against the real navigator, mapper and pose
// tracker of a simulated robot, without a window.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "gui/model/clock.hpp"
#include "gui/model/ros_link.hpp"
#include "test/wait_for.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

class PlaceSystem : public ::testing::Test {
 protected:
  // Outlive everything: a ROS call may still use them while the test ends.
  static ConsoleState& state() {
    static auto& state = *new ConsoleState;
    return state;
  }
  static RosLink& link() {
    static auto& link = *new RosLink({"console"}, state());
    return link;
  }
  static void SetUpTestSuite() {
    link().start();
    ASSERT_TRUE(waitFor([] {
      return state().place.map.latest() && state().place.pose.latest() &&
             state().place.task.latest() && knownFree(ahead(2.4)) && knownFree(ahead(2.5));
    })) << "no map of what lies ahead, no pose or no task";
  }
  static bool knownFree(Eigen::Vector2d place) {
    const MapCells& cells = state().place.map.latest()->cells;
    return cells.at(cells.column(place.x()), cells.row(place.y())) == MapCell::kFree;
  }
  static void TearDownTestSuite() { link().stop(5.0); }

  static void ask(const std::function<void(PlaceAsks&)>& what) { link().askPlace(what); }
  static AskAnswer answerTo(const std::function<void(PlaceAsks&)>& what) {
    const auto before = state().place.answer.get().serial;
    ask(what);
    EXPECT_TRUE(waitFor([&] { return state().place.answer.get().serial != before; }));
    return state().place.answer.get();
  }
  /// Asked again where a busy computer made the pose too old to plan from.
  static Preview preview(const PlaceGoal& goal, const std::optional<Pose2>& from = {}) {
    Preview newest;
    EXPECT_TRUE(waitFor([&] {
      newest = previewOnce(goal, from);
      return newest.why.find(" s old, limit ") == std::string::npos;
    })) << newest.why;
    return newest;
  }
  static Preview previewOnce(const PlaceGoal& goal, const std::optional<Pose2>& from) {
    static std::uint32_t id = 100;
    ++id;
    ask([&](PlaceAsks& asks) { asks.preview(id, goal, from); });
    EXPECT_TRUE(waitFor([&] {
      const auto newest = state().place.preview.get();
      return newest && newest->id == id;
    }));
    return *state().place.preview.get();
  }
  static Eigen::Vector2d ahead(double metres) {
    const Pose2 pose = state().place.pose.latest()->pose;
    return pose * Eigen::Vector2d(metres, 0.0);
  }
  static bool phase(TaskPhase wanted) {
    return waitFor([&] { return state().place.task.latest()->phase == wanted; });
  }
};

TEST_F(PlaceSystem, previewsAWayOrTellsWhyThereIsNone) {
  const Preview way = preview({ahead(2.4), std::nullopt});
  ASSERT_TRUE(way.answered) << way.why;
  ASSERT_TRUE(way.found) << way.why;
  EXPECT_GT(way.path.length, 2.2);
  EXPECT_LT(way.path.length, 4.0);
  EXPECT_LT((way.path.points.back() - ahead(2.4)).norm(), 0.15);
  EXPECT_GT(way.time, 0.0);
  EXPECT_NEAR(way.path.length / way.time, 0.35, 0.01) << "the navigator's cruise";
  const Pose2 here = state().place.pose.latest()->pose;
  const Eigen::Vector2d from = ahead(2.4);
  const Preview leg = preview({ahead(2.5), std::nullopt}, Pose2{from.x(), from.y(), here.heading});
  ASSERT_TRUE(leg.found) << leg.why;
  EXPECT_LT(leg.path.length, 0.5) << "from the place that was told";
  EXPECT_LT((leg.path.points.front() - from).norm(), 0.15);
  const Preview none = preview({{500.0, 500.0}, std::nullopt});
  EXPECT_TRUE(none.answered);
  EXPECT_FALSE(none.found);
  EXPECT_FALSE(none.why.empty());
  const Preview nowhere = preview({{std::nan(""), 0.0}, std::nullopt});
  EXPECT_FALSE(nowhere.found);
  EXPECT_FALSE(nowhere.why.empty());
}

TEST_F(PlaceSystem, routesAreKeptByTheRobot) {
  RouteDraft draft;
  draft.name = "console_place_test";
  draft.loop = true;
  draft.points = {{{{1.0, 0.5}, 0.25}, 3.0}, {{{2.0, -0.5}, std::nullopt}, 0.0}};
  AskAnswer answer = answerTo([&](PlaceAsks& asks) { asks.saveRoute(draft); });
  EXPECT_TRUE(answer.done) << answer.text;
  answer = answerTo([&](PlaceAsks& asks) { asks.loadRoute(draft.name); });
  EXPECT_TRUE(answer.done) << answer.text;
  const auto shelf = state().place.shelf.get();
  ASSERT_TRUE(shelf && shelf->route);
  EXPECT_EQ(*shelf->route, draft);
  EXPECT_EQ(std::count(shelf->files.begin(), shelf->files.end(), draft.name), 1);
  draft.name = "../escaped";
  answer = answerTo([&](PlaceAsks& asks) { asks.saveRoute(draft); });
  EXPECT_FALSE(answer.done);
  EXPECT_NE(answer.text.find("escaped"), std::string::npos) << answer.text;
  answer = answerTo([](PlaceAsks& asks) { asks.loadRoute("never_saved"); });
  EXPECT_FALSE(answer.done);
  EXPECT_FALSE(answer.text.empty());
}

TEST_F(PlaceSystem, aGoalIsTakenPausedGoesOnAndIsCancelled) {
  const Eigen::Vector2d there = ahead(2.4);
  EXPECT_TRUE(answerTo([&](PlaceAsks& asks) { asks.goTo({there, 0.0}); }).done);
  ASSERT_TRUE(phase(TaskPhase::kRunning)) << state().place.task.latest()->text;
  EXPECT_EQ(state().place.task.latest()->behaviour, "go_to");
  EXPECT_TRUE(waitFor([&] {
    const auto navigation = state().place.navigation.latest();
    return navigation && (navigation->goal - there).norm() < 0.01;
  }));
  EXPECT_TRUE(waitFor([] {
    const auto path = state().place.path.get();
    return path && path->points.size() > 1;
  }));
  EXPECT_TRUE(answerTo([](PlaceAsks& asks) { asks.task(TaskCall::kPause); }).done);
  EXPECT_TRUE(phase(TaskPhase::kPaused));
  EXPECT_TRUE(answerTo([](PlaceAsks& asks) { asks.task(TaskCall::kResume); }).done);
  EXPECT_TRUE(phase(TaskPhase::kRunning));
  EXPECT_TRUE(answerTo([](PlaceAsks& asks) { asks.task(TaskCall::kCancel); }).done);
  EXPECT_TRUE(phase(TaskPhase::kCancelled));
  const AskAnswer twice = answerTo([](PlaceAsks& asks) { asks.task(TaskCall::kPause); });
  EXPECT_FALSE(twice.done) << "nothing to pause";
  EXPECT_FALSE(twice.text.empty());
}

TEST_F(PlaceSystem, aRouteIsDrivenPointByPointAndSkipped) {
  RouteDraft draft;
  draft.points = {{{ahead(2.2), std::nullopt}, 0.0}, {{ahead(2.5), std::nullopt}, 5.0}};
  const AskAnswer answer = answerTo([&](PlaceAsks& asks) { asks.driveRoute(draft); });
  ASSERT_TRUE(answer.done) << answer.text;
  EXPECT_TRUE(waitFor([] {
    const auto navigation = state().place.navigation.latest();
    return navigation->points == 2 && navigation->point == 0;
  }));
  EXPECT_TRUE(answerTo([](PlaceAsks& asks) { asks.task(TaskCall::kSkip); }).done);
  EXPECT_TRUE(waitFor([] { return state().place.navigation.latest()->point == 1; }));
  answerTo([](PlaceAsks& asks) { asks.task(TaskCall::kCancel); });
  draft.points.clear();
  EXPECT_FALSE(answerTo([&](PlaceAsks& asks) { asks.driveRoute(draft); }).done);
}

TEST_F(PlaceSystem, theMapIsSavedLoadedAndCleared) {
  AskAnswer answer = answerTo([](PlaceAsks& asks) { asks.saveMap("console_place_test"); });
  EXPECT_TRUE(answer.done) << answer.text;
  EXPECT_NE(answer.text.find("console_place_test"), std::string::npos) << answer.text;
  answer = answerTo([](PlaceAsks& asks) { asks.loadMap("console_place_test"); });
  EXPECT_TRUE(answer.done) << answer.text;
  answer = answerTo([](PlaceAsks& asks) { asks.loadMap("never_saved"); });
  EXPECT_FALSE(answer.done);
  EXPECT_NE(answer.text.find("never_saved"), std::string::npos) << answer.text;
  answer = answerTo([](PlaceAsks& asks) { asks.saveMap("../escaped"); });
  EXPECT_FALSE(answer.done);
  answer = answerTo([](PlaceAsks& asks) { asks.clearMap(); });
  EXPECT_TRUE(answer.done) << answer.text;
  EXPECT_FALSE(answer.text.empty());
}

// Also where scans say otherwise: what they met before belongs to the pose that was wrong.
TEST_F(PlaceSystem, aPoseSetByHandIsTaken) {
  for (const PoseSpread& spread : {PoseSpread{}, PoseSpread{0.05, 0.03}}) {
    Pose2 wanted = state().place.pose.latest()->pose;
    wanted.x += 1.5;
    EXPECT_TRUE(answerTo([&](PlaceAsks& asks) { asks.setPose(wanted, spread); }).done);
    const auto near = [&] {
      const Pose2 pose = state().place.pose.latest()->pose;
      return std::hypot(pose.x - wanted.x, pose.y - wanted.y) < 0.5;
    };
    EXPECT_TRUE(waitFor(near)) << spread.place;
    // Some scans later it stands there still.
    const double set_at = state().place.pose.latest()->at;
    EXPECT_TRUE(waitFor([&] { return state().place.pose.latest()->at > set_at + 1.0; }));
    EXPECT_TRUE(near()) << spread.place << " m of spread: " << state().place.pose.latest()->pose.x
                        << " instead of " << wanted.x;
  }
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
