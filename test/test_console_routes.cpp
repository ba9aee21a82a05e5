// Routes on the map as the operator edits, saves, loads and sends them.

#include <QLineEdit>

#include "gui/view/route_tool.hpp"
#include "test/place_console.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

TEST_F(PlaceConsole, aRouteIsEditedByMouseAndEveryStepTakenBack) {
  press(Qt::Key_R);
  RouteTool& route = place->routeTool();
  click(-1, -1);
  click(1, -1);
  click(1, 0.5);
  ASSERT_EQ(route.draft().points.size(), 3U);
  click(0, -1);  // on the first leg
  ASSERT_EQ(route.draft().points.size(), 4U);
  EXPECT_NEAR(route.draft().points[1].goal.place.x(), 0.0, 0.05);
  drag({1, 0.5}, {2, 0.0});
  EXPECT_NEAR(route.draft().points[3].goal.place.x(), 2.0, 0.05);
  const RouteDraft moved = route.draft();
  press(Qt::Key_Delete);
  EXPECT_EQ(route.draft().points.size(), 3U);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(route.draft(), moved);
  for (int i = 0; i < 10; ++i) press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(route.draft().empty());
  for (int i = 0; i < 5; ++i) press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(route.draft(), moved);
}

TEST_F(PlaceConsole, aRouteIsEditedByKeysAloneAndSent) {
  press(Qt::Key_R);
  RouteTool& route = place->routeTool();
  press(Qt::Key_Insert);
  for (int i = 0; i < 4; ++i) press(Qt::Key_Right);  // the chosen point moves
  press(Qt::Key_Insert);
  for (int i = 0; i < 4; ++i) press(Qt::Key_Up);
  ASSERT_EQ(route.draft().points.size(), 2U);
  EXPECT_GT(route.draft().points[0].goal.place.x(), 0.1);
  EXPECT_GT(route.draft().points[1].goal.place.y(), 0.1);
  const Eigen::Vector2d first = route.draft().points[0].goal.place;
  press(Qt::Key_PageUp);
  EXPECT_EQ(route.draft().points[1].goal.place, first);
  press(Qt::Key_O);
  EXPECT_TRUE(route.draft().loop);
  press(Qt::Key_BracketRight);
  EXPECT_EQ(route.selected(), 1U);
  route.setPause(4.0);
  press(Qt::Key_Return);
  ASSERT_EQ(asked.driven.size(), 1U);
  EXPECT_EQ(asked.driven[0], route.draft());
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(route.draft().points[1].pause, 0.0);
  // A key held down is one step: both nudges of a point go with one undo each.
  for (int i = 0; i < 3; ++i) press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_NEAR(route.draft().points[1].goal.place.y(), first.y(), 1e-9);
}

TEST_F(PlaceConsole, theWaysOfARouteAreShownBeforeItIsSent) {
  press(Qt::Key_R);
  RouteTool& route = place->routeTool();
  click(1, 1);
  click(2, 0);
  EXPECT_NE(route.words().headline.find("1.4 m straight"), std::string::npos);
  const std::size_t goals = asked.previews.size();
  for (int legs = 1; legs <= 2; ++legs) {
    ASSERT_TRUE(QTest::qWaitFor([&] {
      refresh();
      return asked.previews.size() == goals + static_cast<std::size_t>(legs);
    }));
    answer(true);
  }
  EXPECT_FALSE(asked.starts[goals]) << "from the robot to the first point";
  ASSERT_TRUE(asked.starts[goals + 1]);
  EXPECT_NEAR(asked.starts[goals + 1]->x, 1.0, 0.05);
  EXPECT_EQ(route.words().headline, "2 points, 4.6 m, about 14 s");
  press(Qt::Key_R);
  const std::size_t asks = asked.previews.size();
  QTest::qWait(600);
  refresh();
  EXPECT_EQ(asked.previews.size(), asks) << "laid down, it asks nothing";
}

TEST_F(PlaceConsole, routesAreSavedUnderAGoodNameAndLoadedAsOneStep) {
  press(Qt::Key_R);
  click(1, 1);
  click(2, 0);
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(asked.saved.empty()) << "it has no name";
  auto* name = window->findChild<QLineEdit*>("route_name");
  ASSERT_TRUE(name);
  EXPECT_TRUE(name->hasFocus());
  QTest::keyClicks(name, "ro/und");
  EXPECT_EQ(place->routeTool().draft().name, "round");
  QTest::keyClick(name, Qt::Key_S, Qt::ControlModifier);
  shelve({}, {"other"});
  ASSERT_EQ(asked.saved.size(), 1U) << "also from the field";
  press(Qt::Key_Return);
  EXPECT_TRUE(asked.driven.empty()) << "Enter in a field only ends the field";
  EXPECT_FALSE(name->hasFocus());
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(asked.saved.size(), 2U) << "over its own file without a word";
  const RouteDraft mine = place->routeTool().draft();
  const RouteDraft other{"other", true, {{{{0, 0}, 1.0}, 2.0}, {{{1, 1}, {}}, 0.0}}};
  shelve(other, {"other", "round"});
  EXPECT_EQ(place->routeTool().draft(), other);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(place->routeTool().draft(), mine) << "with its name";
  press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(place->routeTool().draft(), other);
}

TEST_F(PlaceConsole, anotherRouteIsReplacedOnlyWhenToldTwice) {
  press(Qt::Key_R);
  click(1, 1);
  place->routeTool().setName("kitchen");
  press(Qt::Key_S, Qt::ControlModifier);
  shelve({}, {"hall", "kitchen"});
  EXPECT_TRUE(asked.saved.empty());
  EXPECT_EQ(place->routeTool().words().headline, "The robot has a route kitchen already");
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(asked.saved.size(), 1U);
  // An answer about a name that was given up saves nothing.
  place->routeTool().setName("hall");
  press(Qt::Key_S, Qt::ControlModifier);
  place->routeTool().setName("attic");
  shelve({}, {"hall", "kitchen"});
  EXPECT_EQ(asked.saved.size(), 1U);
}

TEST_F(PlaceConsole, afterAnUndoTheKeysMoveTheSamePointFromWhereItIs) {
  press(Qt::Key_R);
  RouteTool& route = place->routeTool();
  click(-1, -1);
  click(1, -1);
  const double before = route.draft().points[1].goal.place.x();
  press(Qt::Key_Right);
  const double step = route.draft().points[1].goal.place.x() - before;
  ASSERT_GT(step, 0.0);
  for (int i = 0; i < 9; ++i) press(Qt::Key_Right);
  press(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_DOUBLE_EQ(route.draft().points[1].goal.place.x(), before);
  press(Qt::Key_Right);
  EXPECT_NEAR(route.draft().points[1].goal.place.x(), before + step, 1e-9);
  press(Qt::Key_Z, Qt::ControlModifier);
  const RouteDraft two = route.draft();
  click(0, -1);  // on the leg
  ASSERT_EQ(route.draft().points.size(), 3U);
  press(Qt::Key_Z, Qt::ControlModifier);
  press(Qt::Key_Up);
  EXPECT_EQ(route.draft(), two) << "the one that was chosen has gone; no other moves";
}

TEST_F(PlaceConsole, aDragEndsWhereItsPointIsTakenAway) {
  press(Qt::Key_R);
  RouteTool& route = place->routeTool();
  for (const double x : {-1.0, 0.0, 1.0}) click(x, -1);
  for (const bool undo : {false, true}) {
    const auto begin = at(0, -1);
    QTest::mousePress(canvas, Qt::LeftButton, {}, begin);
    const auto moveTo = [&](double x, double y) {
      QMouseEvent move(QEvent::MouseMove, QPointF(at(x, y)), Qt::NoButton, Qt::LeftButton,
                       Qt::NoModifier);
      QApplication::sendEvent(canvas, &move);
    };
    moveTo(0.5, 0.5);
    undo ? press(Qt::Key_Z, Qt::ControlModifier) : press(Qt::Key_Delete);
    const RouteDraft left = route.draft();
    moveTo(0.6, 0.6);
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, at(0.6, 0.6));
    EXPECT_EQ(route.draft(), left);
    if (!undo) press(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_EQ(route.draft().points.size(), undo ? 2U : 3U);
  }
}

TEST_F(PlaceConsole, aPointTooManyIsToldAndTurnsNoOther) {
  press(Qt::Key_R);
  RouteTool& route = place->routeTool();
  RouteDraft full;
  for (std::size_t i = 0; i < RouteDraft::kMostPoints; ++i) {
    full.points.push_back({{{2.0, -1.5 + 0.001 * static_cast<double>(i)}, std::nullopt}, 0.0});
  }
  route.history().step(full, "fill");
  route.select(3);
  drag({-1, 1}, {-2, 1});
  EXPECT_EQ(route.draft(), full);
  EXPECT_EQ(route.words().headline, "1,000 points are the most that a route has");
  press(Qt::Key_Insert);
  EXPECT_EQ(route.draft(), full);
}

TEST_F(PlaceConsole, thePointUnderWayIsMarkedOnlyOfThisVeryRoute) {
  press(Qt::Key_R);
  click(-1, -1);
  click(1, -1);
  TaskReading task;
  task.phase = TaskPhase::kRunning;
  task.behaviour = "route";
  deliver<TaskReading>(state.place.task, std::make_shared<TaskReading>(task));
  NavigationReading navigation;
  navigation.phase = NavigationPhase::kDriving;
  navigation.points = 2;
  navigation.point = 1;
  navigation.goal = {7, 7};
  deliver<NavigationReading>(state.place.navigation,
                             std::make_shared<NavigationReading>(navigation));
  EXPECT_FALSE(place->routeTool().underWay());
  navigation.goal = place->routeTool().draft().points[1].goal.place;
  deliver<NavigationReading>(state.place.navigation,
                             std::make_shared<NavigationReading>(navigation));
  EXPECT_EQ(place->routeTool().underWay(), 1U);
}

}  // namespace

int main(int argc, char** argv) {
  return runPlaceTests(argc, argv);
}
