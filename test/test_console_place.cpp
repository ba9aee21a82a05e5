// The console's logic of the place: words about tasks, the view, keys that aim, errands.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <memory>

#include "gui/model/errand_thread.hpp"
#include "gui/model/goal_aim.hpp"
#include "gui/model/map_view.hpp"
#include "gui/model/rewind_watch.hpp"
#include "gui/model/route_draft.hpp"
#include "gui/model/task_words.hpp"
#include "gui/model/teleop.hpp"
#include "gui/model/trail.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TaskSituation running(NavigationPhase phase) {
  TaskSituation s;
  s.task_state.ever = s.navigation_state.ever = true;
  s.task.phase = TaskPhase::kRunning;
  s.task.behaviour = "route";
  s.navigation.phase = phase;
  s.navigation.points = 5;
  s.navigation.point = 1;
  s.navigation.distance_left = 3.24;
  s.navigation.time_left = 75.0;
  return s;
}

TEST(RewindWatch, noticesABagThatIsPlayedAgainButNoLatePublisher) {
  RewindWatch watch;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(watch.rewound("base_link", 100.0 + 0.1 * i));
  EXPECT_FALSE(watch.rewound("odom", 95.0)) << "each frame has its own time";
  EXPECT_FALSE(watch.rewound("base_link", 100.0)) << "one alone may be late";
  EXPECT_FALSE(watch.rewound("base_link", 110.0));
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(watch.rewound("base_link", 109.5)) << "a bit behind";
  EXPECT_FALSE(watch.rewound("base_link", 100.0));
  EXPECT_FALSE(watch.rewound("base_link", 100.1));
  EXPECT_TRUE(watch.rewound("base_link", 100.2));
  for (int i = 3; i < 100; ++i) EXPECT_FALSE(watch.rewound("base_link", 100.0 + 0.1 * i));
}

TEST(RouteDraft, aPointIsFollowedThroughWhatBecomesOfItsRoute) {
  const auto route = [](const std::vector<double>& xs) {
    RouteDraft draft;
    for (const double x : xs) draft.points.push_back({{{x, 0.0}, std::nullopt}, 0.0});
    return draft;
  };
  EXPECT_EQ(pointAfter(route({1, 2, 3}), 1, route({1, 5, 3})), 1U) << "moved";
  EXPECT_EQ(pointAfter(route({1, 2, 3}), 1, route({2, 3})), 0U) << "another one removed";
  EXPECT_EQ(pointAfter(route({1, 2, 3}), 1, route({1, 3, 2})), 2U) << "in another order";
  EXPECT_FALSE(pointAfter(route({1, 2, 3}), 1, route({1, 3}))) << "removed itself";
  EXPECT_FALSE(pointAfter(route({1}), 4, route({1})));
}

TEST(TaskWords, tellWhatRunsHowFarAndHowLong) {
  TaskSituation route = running(NavigationPhase::kDriving);
  route.task.text = "point 2 of 5";
  const TaskWords words = taskWords(route);
  EXPECT_EQ(words.state, "Running");
  EXPECT_EQ(words.headline, "to point 2 of 5");
  EXPECT_EQ(words.why, "") << "not the same words again";
  EXPECT_EQ(words.left, "3.2 m, 1 min 15 s left");
  EXPECT_TRUE(words.can_pause && words.can_skip && words.can_cancel);
  EXPECT_FALSE(words.can_resume);
}

TEST(TaskWords, tellWhyItWaitsIsPausedOrFailed) {
  TaskSituation s = running(NavigationPhase::kWaiting);
  s.navigation.text = "a person stands in the way";
  EXPECT_EQ(taskWords(s).state, "Waiting");
  EXPECT_EQ(taskWords(s).why, "a person stands in the way");
  s = running(NavigationPhase::kDriving);
  s.gate_stopped = true;
  EXPECT_EQ(taskWords(s).why, "the stop gate holds the robot until it is armed");
  s.task.phase = TaskPhase::kPaused;
  EXPECT_EQ(taskWords(s).state, "Paused");
  EXPECT_TRUE(taskWords(s).can_resume);
  EXPECT_FALSE(taskWords(s).can_pause);
  s.task.phase = TaskPhase::kFailed;
  s.task.text = "the way is blocked";
  EXPECT_EQ(taskWords(s).severity, Severity::kError);
  EXPECT_EQ(taskWords(s).why, "the way is blocked");
  EXPECT_FALSE(taskWords(s).can_cancel);
  s.task.refused = "goal: frame \"moon\" is unknown";
  EXPECT_EQ(taskWords(s).why, "refused: goal: frame \"moon\" is unknown");
}

TEST(TaskWords, aSilentNavigatorIsNoRunningOne) {
  TaskSituation s = running(NavigationPhase::kDriving);
  s.task_state.age_s = 5.0;
  EXPECT_EQ(taskWords(s).state, "Silent");
  EXPECT_EQ(taskWords(s).left, "");
  s = TaskSituation();
  EXPECT_EQ(taskWords(s).state, "No navigator");
}

TEST(Words, lengthsAndTimes) {
  EXPECT_EQ(lengthWords(0.854), "85 cm");
  EXPECT_EQ(lengthWords(12.44), "12.4 m");
  EXPECT_EQ(lengthWords(kNaN), "?");
  EXPECT_EQ(timeWords(59.6), "1 min");
  EXPECT_EQ(timeWords(34.6), "35 s");
  EXPECT_EQ(timeWords(3725), "1 h 2 min");
  EXPECT_EQ(timeWords(kNaN), "?");
}

TEST(MapView, eastIsRightNorthIsUpAndBothWaysAreInverses) {
  MapView view(MapView::Axes::kEastRight);
  view.resize({640, 480});
  view.fit({-2.0, -1.0, 8.0, 4.0}, {10, 20}, {30, 40});
  EXPECT_GT(view.toPixel(1, 0).x(), view.toPixel(0, 0).x());
  EXPECT_LT(view.toPixel(0, 1).y(), view.toPixel(0, 0).y());
  const QPointF corner = view.toPixel(-2.0, 3.0);
  EXPECT_GE(corner.x(), 10 - 1e-9);
  EXPECT_GE(corner.y(), 20 - 1e-9);
  const QPointF other = view.toPixel(6.0, -1.0);
  EXPECT_LE(other.x(), 610 + 1e-9);
  EXPECT_LE(other.y(), 440 + 1e-9);
  const QPointF before = view.toMetres({100, 100});
  view.zoomAbout({100, 100}, 1.7);
  EXPECT_NEAR(view.toMetres({100, 100}).x(), before.x(), 1e-9);
  view.panBy({13, -7});
  EXPECT_NEAR(view.toMetres({113, 93}).y(), before.y(), 1e-9);
}

TEST(Trail, growsByStepsAndBreaksAtJumps) {
  Trail trail;
  EXPECT_TRUE(trail.add({0, 0}));
  EXPECT_FALSE(trail.add({0.01, 0}));
  EXPECT_TRUE(trail.add({0.05, 0}));
  EXPECT_FALSE(trail.points().back().begins);
  EXPECT_TRUE(trail.add({5, 0}));
  EXPECT_TRUE(trail.points().back().begins);
  EXPECT_FALSE(trail.add({kNaN, 0}));
  for (int i = 0; i < 7000; ++i) trail.add({0.1 * i, 9});
  EXPECT_EQ(trail.points().size(), Trail::kMost);
}

TEST(AimingArrows, anArrowPressedToAimNeverBeginsToDrive) {
  Teleop teleop{BaseParameters()};
  const KeyMeaning arrow{DriveKey::kForward, 1};
  teleop.pressElsewhere(arrow, 0.0);
  EXPECT_FALSE(teleop.step(0.01, HandsOff::kNone));
  // Held on: X sends release and press again and again, by now perhaps as a driving key.
  for (double now = 0.04; now < 0.5; now += 0.04) {
    teleop.release(arrow, now);
    teleop.press(arrow, now + 0.001);
    EXPECT_FALSE(teleop.step(now + 0.002, HandsOff::kNone)) << now;
  }
  teleop.release(arrow, 0.6);
  EXPECT_FALSE(teleop.step(0.7, HandsOff::kNone));
  teleop.press(arrow, 0.8);
  const auto command = teleop.step(0.81, HandsOff::kNone);
  ASSERT_TRUE(command) << "pressed anew it drives";
  EXPECT_GT(command->vx, 0.0);
}

TEST(ErrandThread, anErrandThatHangsGathersNothingAndOnlyTheNewestPreviewIsMade) {
  std::promise<void> go, made;
  std::vector<int> previews;
  {
    ErrandThread thread([](const std::string&) {});
    thread.add("hangs", [&] { go.get_future().wait(); });
    for (int i = 1; i <= 10; ++i) {
      thread.addIdle("plan", [&, i] {
        previews.push_back(i);
        made.set_value();
      });
    }
    std::size_t taken = 0;
    while (taken < 1000 && thread.add("waits", [] {})) ++taken;
    EXPECT_LT(taken, 1000U);
    go.set_value();
    ASSERT_EQ(made.get_future().wait_for(std::chrono::seconds(20)), std::future_status::ready);
  }
  EXPECT_EQ(previews, std::vector<int>{10});
}

TEST(ErrandThread, endsThoughAnErrandHangs) {
  auto go = std::make_shared<std::promise<void>>();
  auto ended = std::make_shared<std::promise<void>>();
  auto begun = std::make_shared<std::promise<void>>();
  {
    ErrandThread thread([](const std::string&) {});
    thread.add("hangs", [go, ended, begun] {
      begun->set_value();
      go->get_future().wait();
      ended->set_value();
    });
    begun->get_future().wait();
  }
  go->set_value();  // only now could it end: the thread was left behind
  EXPECT_EQ(ended->get_future().wait_for(std::chrono::seconds(20)), std::future_status::ready);
}

}  // namespace
