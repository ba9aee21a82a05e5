// The map that stays in place, its goals, poses, layers and tasks as the operator uses them.

#include <QAction>
#include <QDialog>
#include <QDialogButtonBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <cmath>
#include <set>

#include "gui/model/class_colours.hpp"
#include "gui/view/task_bar.hpp"
#include "test/place_console.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

TEST_F(PlaceConsole, aGoalIsShownWithItsWayBeforeItIsSent) {
  press(Qt::Key_G);
  drag({2, 1}, {2, 1.8});
  refresh();
  ASSERT_FALSE(asked.previews.empty());
  EXPECT_NEAR(asked.previews.back().place.x(), 2.0, 0.05);
  EXPECT_NEAR(asked.previews.back().heading.value_or(0), M_PI / 2, 0.1);
  press(Qt::Key_Return);
  EXPECT_TRUE(asked.goals.empty()) << "its way is not known yet";
  answer(true);
  const QImage shot = canvas->grab().toImage();
  int drawn = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.5 + 0.01 * i;  // the way is dashed
    drawn += QColor(shot.pixel(at(x, 0.5 * x))).red() > 200 ? 1 : 0;
  }
  EXPECT_GT(drawn, 35) << "the way is drawn";
  EXPECT_LT(QColor(shot.pixel(at(1, -0.5))).red(), 100);
  press(Qt::Key_Return);
  ASSERT_EQ(asked.goals.size(), 1U);
  EXPECT_NEAR(asked.goals[0].place.y(), 1.0, 0.05);
}

TEST_F(PlaceConsole, aSecondClickOnTheGhostSendsAndOneElsewhereMovesIt) {
  press(Qt::Key_G);
  click(2, 1);
  refresh();
  answer(true);
  click(1, -1);
  refresh();
  EXPECT_TRUE(asked.goals.empty());
  EXPECT_NEAR(asked.previews.back().place.y(), -1.0, 0.05);
  EXPECT_FALSE(asked.previews.back().heading) << "a click without a drag: any heading";
  answer(true);
  click(1, -1);
  ASSERT_EQ(asked.goals.size(), 1U);
}

TEST_F(PlaceConsole, keysAloneAimTurnAndSendAndNothingDrives) {
  press(Qt::Key_G);
  for (int i = 0; i < 5; ++i) press(Qt::Key_Right);
  press(Qt::Key_Up);
  press(Qt::Key_Return);
  press(Qt::Key_Comma);
  refresh();
  ASSERT_FALSE(asked.previews.empty());
  const PlaceGoal goal = asked.previews.back();
  EXPECT_GT(goal.place.x(), 0.2);
  EXPECT_NEAR(goal.place.y(), goal.place.x() / 5, 1e-9);
  EXPECT_NEAR(goal.heading.value_or(0), 15.0 * M_PI / 180.0, 1e-9);
  answer(true);
  press(Qt::Key_Return);
  EXPECT_EQ(asked.goals.size(), 1U);
  EXPECT_FALSE(helm.view().driving);
  EXPECT_FALSE(helm.stopped());
  // Without a tool the arrows are the driver's again.
  press(Qt::Key_G);
  EXPECT_FALSE(helm.arrowsAim());
}

TEST_F(PlaceConsole, noSecondClickOfADoubleClickSendsAndNoKeyThatIsHeldDown) {
  press(Qt::Key_I);
  click(1, 1);
  QTest::mouseDClick(canvas, Qt::LeftButton, {}, at(1, 1));
  EXPECT_TRUE(asked.poses.empty());
  EXPECT_TRUE(place->poseTool().aim().goal()) << "it waits to be looked at";
  lookAtIt();
  click(1, 1);
  EXPECT_EQ(asked.poses.size(), 1U);
  std::set<QString> repeated;
  for (const auto* action : window->findChildren<QAction*>()) {
    if (!action->autoRepeat()) continue;
    for (const auto& key : action->shortcuts()) repeated.insert(key.toString());
  }
  EXPECT_EQ(repeated, (std::set<QString>{",", ".", "+", "=", "-", "F", "Ctrl+Left", "Ctrl+Right",
                                         "Ctrl+Up", "Ctrl+Down"}));
}

// As X hands them over when the pair is torn apart: neither is marked.
TEST_F(PlaceConsole, whatTheKeyboardRepeatsUnmarkedIsNoShortcut) {
  const auto becomesShortcut = [&](unsigned long released, unsigned long pressed) {
    QKeyEvent release(QEvent::KeyRelease, Qt::Key_F6, Qt::NoModifier);
    release.setTimestamp(released);
    QApplication::sendEvent(window.get(), &release);
    QKeyEvent press(QEvent::ShortcutOverride, Qt::Key_F6, Qt::NoModifier);
    press.setTimestamp(pressed);
    press.ignore();
    QApplication::sendEvent(window.get(), &press);
    return !press.isAccepted();
  };
  EXPECT_FALSE(becomesShortcut(1400, 1400)) << "the keyboard's";
  EXPECT_TRUE(becomesShortcut(1440, 1600)) << "a finger's";
}

TEST_F(PlaceConsole, noWayTellsWhyAndOneKeyTakesTheNearestPlace) {
  press(Qt::Key_G);
  click(2.5, 1.5);
  refresh();
  answer(false);
  EXPECT_EQ(place->goalTool().words().headline, "No way there: something stands there");
  press(Qt::Key_Return);
  EXPECT_TRUE(asked.goals.empty());
  press(Qt::Key_T);
  QTest::qWait(200);
  refresh();
  EXPECT_NEAR(asked.previews.back().place.x(), 1.5, 1e-9);
}

TEST_F(PlaceConsole, takingBackStopsNothingAndTheStopKeyStopsWithAToolInHand) {
  press(Qt::Key_G);
  click(2, 1);
  press(Qt::Key_Backspace);
  EXPECT_FALSE(place->goalTool().aim().goal());
  EXPECT_FALSE(helm.stopped());
  click(2, 1);
  press(Qt::Key_Escape);
  EXPECT_FALSE(place->goalTool().aim().goal());
  EXPECT_TRUE(helm.stopped());
  EXPECT_FALSE(helm.arrowsAim());
  helm.release(helm.stops());
  press(Qt::Key_R);
  press(Qt::Key_Space);
  EXPECT_TRUE(helm.stopped());
}

TEST_F(PlaceConsole, aPoseIsSetWithItsSpread) {
  press(Qt::Key_I);
  drag({-1, 0.5}, {-2, 0.5});
  press(Qt::Key_BracketRight);
  const double stated = place->poseTool().spread().place;
  EXPECT_GT(stated, PoseSpread().place);
  press(Qt::Key_Return);
  EXPECT_TRUE(asked.poses.empty()) << "shown first";
  lookAtIt();
  press(Qt::Key_Return);
  ASSERT_EQ(asked.poses.size(), 1U);
  EXPECT_NEAR(std::abs(asked.poses[0].first.heading), M_PI, 0.1);
  EXPECT_DOUBLE_EQ(asked.poses[0].second.place, stated);
  EXPECT_TRUE(asked.previews.empty()) << "a pose needs no way";
}

TEST_F(PlaceConsole, layersSwitchByTheirKeys) {
  const auto wall = [&] { return QColor(canvas->grab().toImage().pixel(at(-2, 1.95))); };
  EXPECT_EQ(wall(), QColor(mapCellColour(MapCell::kOccupied)));
  press(Qt::Key_1);
  EXPECT_NE(wall(), QColor(mapCellColour(MapCell::kOccupied)));
  press(Qt::Key_1);
  EXPECT_EQ(wall(), QColor(mapCellColour(MapCell::kOccupied)));
  const auto robot_there = [&] { return QColor(canvas->grab().toImage().pixel(at(-0.1, 0))); };
  EXPECT_GT(robot_there().lightness(), 200);
  press(Qt::Key_7);
  EXPECT_LT(robot_there().lightness(), 100);
}

TEST_F(PlaceConsole, theRobotIsDrawnWhereItIsAndWithItsHeading) {
  auto pose = std::make_shared<PoseReading>();
  pose->frame = "map";
  pose->pose = {1.5, -1.0, M_PI / 2};
  deliver<PoseReading>(state.place.pose, pose);
  refresh();
  const QImage shot = canvas->grab().toImage();
  const auto bright = [&](double x, double y) {
    return QColor(shot.pixel(at(x, y))).lightness() > 200;
  };
  EXPECT_TRUE(bright(1.5, -1.15));
  EXPECT_TRUE(bright(1.5 + 0.15, -1.0 - 0.2)) << "it is longer along its heading";
  EXPECT_FALSE(bright(1.5 + 0.24, -1.0));
  EXPECT_FALSE(bright(0.0, 0.0));
}

TEST_F(PlaceConsole, theTaskBarTellsAndItsKeysAsk) {
  TaskReading task;
  task.id = 3;
  task.phase = TaskPhase::kRunning;
  task.behaviour = "route";
  deliver<TaskReading>(state.place.task, std::make_shared<TaskReading>(task));
  NavigationReading navigation;
  navigation.phase = NavigationPhase::kDriving;
  navigation.points = 3;
  navigation.distance_left = 4.0;
  deliver<NavigationReading>(state.place.navigation,
                             std::make_shared<NavigationReading>(navigation));
  refresh();
  ASSERT_TRUE(window->taskBar()->isVisible());
  EXPECT_EQ(window->taskBar()->words().headline, "to point 1 of 3");
  EXPECT_EQ(window->taskBar()->words().left, "4.0 m left");
  press(Qt::Key_F5);
  task.phase = TaskPhase::kPaused;
  deliver<TaskReading>(state.place.task, std::make_shared<TaskReading>(task));
  refresh();
  press(Qt::Key_F5);
  press(Qt::Key_F6);
  press(Qt::Key_F8);
  EXPECT_EQ(asked.calls, (std::vector<TaskCall>{TaskCall::kPause, TaskCall::kResume,
                                                TaskCall::kSkip, TaskCall::kCancel}));
  state.place.answer.set({1, false, "there is no task", steadySeconds()});
  refresh();
  EXPECT_EQ(window->taskBar()->words().why, "refused: there is no task");
}

TEST_F(PlaceConsole, mapsAreSavedLoadedAndClearedAfterAQuestion) {
  const auto both = Qt::ControlModifier | Qt::ShiftModifier;
  const auto back = [&] {  // the question is gone, the window has the keys again
    refresh();
    window->activateWindow();
    return QTest::qWaitForWindowActive(window.get());
  };
  press(Qt::Key_S, both);
  auto* dialog = window->findChild<QDialog*>("map_name_dialog");
  ASSERT_TRUE(dialog);
  auto* name = dialog->findChild<QLineEdit*>("map_name");
  auto* go = dialog->findChild<QDialogButtonBox*>()->buttons().first();
  ASSERT_EQ(name->text(), "map");
  name->setText("../up");
  EXPECT_FALSE(go->isEnabled());
  name->setText("ground_floor");
  ASSERT_TRUE(go->isEnabled());
  go->click();
  ASSERT_EQ(asked.maps, std::vector<std::string>{"save ground_floor"});
  ASSERT_TRUE(back());

  press(Qt::Key_O, both);
  dialog = window->findChild<QDialog*>("map_name_dialog");
  ASSERT_TRUE(dialog);
  EXPECT_EQ(dialog->findChild<QLineEdit*>("map_name")->text(), "ground_floor") << "the last one";
  QTest::keyClick(dialog->findChild<QLineEdit*>("map_name"), Qt::Key_Return);
  ASSERT_EQ(asked.maps.size(), 2U);
  EXPECT_EQ(asked.maps[1], "load ground_floor");
  ASSERT_TRUE(back());

  for (const int chosen : {1, 0}) {
    press(Qt::Key_Delete, both);
    auto* box = window->findChild<QMessageBox*>("map_clear");
    ASSERT_TRUE(box);
    if (chosen == 1) {
      QTest::keyClick(box, Qt::Key_Return);  // what is at hand forgets nothing
      EXPECT_EQ(asked.maps.size(), 2U);
    } else {
      for (auto* button : box->buttons()) {
        if (box->buttonRole(button) == QMessageBox::AcceptRole) button->click();
      }
    }
    ASSERT_TRUE(back());
  }
  ASSERT_EQ(asked.maps.size(), 3U);
  EXPECT_EQ(asked.maps[2], "clear");

  // What came of it is told for a while.
  LinkStatus link;
  link.phase = LinkPhase::kConnected;
  state.link.set(link);
  state.place.answer.set({1, true, "saved /maps/ground_floor.phmap", 100.0});
  const auto told = [&](double now) {
    for (const auto& notice : notices(situationOf(state, "platform", now))) {
      if (notice.text == "saved /maps/ground_floor.phmap") return true;
    }
    return false;
  };
  EXPECT_TRUE(told(101.0));
  EXPECT_FALSE(told(120.0));
}

TEST_F(PlaceConsole, aToolIsLaidDownWithAMapThatIsNotSeenAndBringsItBack) {
  press(Qt::Key_G);
  click(2, 1);
  refresh();
  answer(true);
  press(Qt::Key_1, Qt::ControlModifier);
  ASSERT_FALSE(canvas->isVisible());
  EXPECT_FALSE(helm.arrowsAim());
  press(Qt::Key_Return);
  EXPECT_TRUE(asked.goals.empty());
  press(Qt::Key_G);
  EXPECT_TRUE(canvas->isVisible());
  EXPECT_TRUE(helm.arrowsAim());
}

TEST_F(PlaceConsole, whatIsInAnotherFrameThanTheMapIsToldAndNotDrawn) {
  auto pose = std::make_shared<PoseReading>();
  pose->frame = "odom";
  pose->pose = {1.5, -1.0, 0.0};
  deliver<PoseReading>(state.place.pose, pose);
  refresh();
  EXPECT_FALSE(canvas->scene().pose);
  EXPECT_EQ(canvas->scene().refused, "the pose is in frame odom, expected map");
  pose = std::make_shared<PoseReading>(*pose);
  pose->frame = "/map";
  deliver<PoseReading>(state.place.pose, pose);
  refresh();
  EXPECT_TRUE(canvas->scene().pose);
  EXPECT_TRUE(canvas->scene().refused.empty());
}

TEST_F(PlaceConsole, ofAnotherRobotNothingOfThePlaceStays) {
  ASSERT_FALSE(canvas->trail().points().empty());
  state.place.forget();
  refresh();
  EXPECT_FALSE(canvas->scene().map);
  EXPECT_FALSE(canvas->scene().pose);
  EXPECT_TRUE(canvas->trail().points().empty());
}

TEST_F(PlaceConsole, everyKeyIsUniqueWithToolsToo) {
  std::set<QString> keys;
  for (const auto* action : window->findChildren<QAction*>()) {
    for (const auto& key : action->shortcuts()) {
      EXPECT_TRUE(keys.insert(key.toString()).second) << qPrintable(key.toString());
    }
  }
  for (const char* driving : {"W", "A", "S", "D", "Q", "E", "Space", "Esc", "Left", "Up", "F9"}) {
    EXPECT_EQ(keys.count(driving), 0U) << driving << " drives or stops";
  }
}

TEST_F(PlaceConsole, aMapOfSixteenMillionCellsIsDrawnFromFewPixels) {
  MapGrid grid;
  grid.info.resolution = 0.05F;
  grid.info.width = grid.info.height = 4000;
  grid.info.origin.orientation.w = 1.0;
  grid.classes.assign(16'000'000, MapGrid::FREE);
  deliver(state.place.map, *mapFromMessage(grid));
  refresh();
  canvas->fit();
  const double begin = steadySeconds();
  for (int i = 0; i < 10; ++i) canvas->grab();
  RecordProperty("paint_ms", static_cast<int>((steadySeconds() - begin) * 100.0));
  EXPECT_EQ(QColor(canvas->grab().toImage().pixel(at(100, 100))),
            QColor(mapCellColour(MapCell::kFree)));
}

}  // namespace

int main(int argc, char** argv) {
  return runPlaceTests(argc, argv);
}
