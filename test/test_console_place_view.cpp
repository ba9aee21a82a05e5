// The map that stays in place and its tools as the operator uses them, on Qt's offscreen platform.

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <set>

#include "gui/model/class_colours.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/conversions_place.hpp"
#include "gui/model/helm.hpp"
#include "gui/view/main_window.hpp"
#include "gui/view/place_view.hpp"
#include "gui/view/route_tool.hpp"
#include "gui/view/task_bar.hpp"
#include "gui/view/theme.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

int qt_warnings = 0;

/// Keeps what was asked.
struct Asked : PlaceAsks {
  std::uint32_t id = 0;
  std::vector<PlaceGoal> previews, goals;
  std::vector<std::pair<Pose2, PoseSpread>> poses;
  std::vector<RouteDraft> driven, saved;
  std::vector<std::string> loaded;
  std::vector<TaskCall> calls;
  void preview(std::uint32_t i, const PlaceGoal& goal) override {
    id = i;
    previews.push_back(goal);
  }
  void goTo(const PlaceGoal& goal) override { goals.push_back(goal); }
  void setPose(const Pose2& pose, const PoseSpread& spread) override {
    poses.emplace_back(pose, spread);
  }
  void driveRoute(const RouteDraft& draft) override { driven.push_back(draft); }
  void saveRoute(const RouteDraft& draft) override { saved.push_back(draft); }
  void loadRoute(const std::string& name) override { loaded.push_back(name); }
  void task(TaskCall call) override { calls.push_back(call); }
};

RobotDescription platform() {
  RobotDescription r;
  r.name = "platform";
  r.title = "Platform";
  r.footprint = {{{0.25, 0.20}}, {{-0.25, 0.20}}, {{-0.25, -0.20}}, {{0.25, -0.20}}};
  return r;
}

template <class T>
void deliver(Feed<T>& feed, std::shared_ptr<const T> what) {
  const double now = steadySeconds();
  feed.arrived(now, 1, "test", "/topic");
  feed.deliver(Checked<std::shared_ptr<const T>>::of(std::move(what)), now, 0.0);
}

/// A room of 6 by 4 m with the robot in its middle, and a navigator.
class PlaceConsole : public ::testing::Test {
 protected:
  void SetUp() override {
    MapGrid grid;
    grid.header.frame_id = "map";
    grid.info.resolution = 0.1F;
    grid.info.width = 60;
    grid.info.height = 40;
    grid.info.origin.position.x = -3.0;
    grid.info.origin.position.y = -2.0;
    grid.info.origin.orientation.w = 1.0;
    grid.classes.assign(2400, MapGrid::FREE);
    for (std::size_t x = 0; x < 60; ++x) grid.classes[39 * 60 + x] = MapGrid::OCCUPIED;
    deliver(state.place.map, *mapFromMessage(grid));
    auto pose = std::make_shared<PoseReading>();
    pose->frame = "map";
    deliver<PoseReading>(state.place.pose, pose);
    TaskReading idle;
    idle.phase = TaskPhase::kIdle;
    deliver<TaskReading>(state.place.task, std::make_shared<TaskReading>(idle));
    window = std::make_unique<MainWindow>(
        PanelContext{state, robot, nullptr, &helm, nullptr,
                     [this](const std::function<void(PlaceAsks&)>& ask) { ask(asked); }},
        false);
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    refresh();
    place = window->findChild<PlaceView*>();
    ASSERT_TRUE(place);
    canvas = place->canvas();
    ASSERT_TRUE(canvas->isVisible()) << "a map and a navigator: the map is what is looked at";
  }
  void refresh() {
    QTest::qWait(60);  // two of the window's own rounds
    window->refreshNow();
  }
  void press(int key, Qt::KeyboardModifiers with = Qt::NoModifier) {
    QTest::keyClick(window.get(), static_cast<Qt::Key>(key), with);
  }
  QPoint at(double x, double y) const { return canvas->view().toPixel(x, y).toPoint(); }
  void click(double x, double y) { QTest::mouseClick(canvas, Qt::LeftButton, {}, at(x, y)); }
  void drag(Eigen::Vector2d from, Eigen::Vector2d to) {
    QTest::mousePress(canvas, Qt::LeftButton, {}, at(from.x(), from.y()));
    for (const double share : {0.5, 1.0}) {
      const Eigen::Vector2d p = from + share * (to - from);
      QMouseEvent move(QEvent::MouseMove, QPointF(at(p.x(), p.y())), Qt::NoButton, Qt::LeftButton,
                       Qt::NoModifier);
      QApplication::sendEvent(canvas, &move);
    }
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, at(to.x(), to.y()));
  }
  void answer(bool way) {
    Preview preview;
    preview.id = asked.id;
    preview.answered = true;
    preview.found = way;
    preview.why = way ? "" : "something stands there";
    preview.path.points = {{0, 0}, {1, 0.5}, {2, 1}};
    preview.path.length = 2.3;
    if (!way) preview.nearest = Eigen::Vector2d(1.5, 0.5);
    state.place.preview.set(std::make_shared<const Preview>(preview));
    refresh();
  }

  ConsoleState state;
  const RobotDescription robot = platform();
  Helm helm{robot.drive};
  Asked asked;
  std::unique_ptr<MainWindow> window;
  PlaceView* place = nullptr;
  PlaceCanvas* canvas = nullptr;
};

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
  helm.release();
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
  EXPECT_TRUE(asked.poses.empty()) << "shown first";
  press(Qt::Key_Return);
  ASSERT_EQ(asked.poses.size(), 1U);
  EXPECT_NEAR(std::abs(asked.poses[0].first.heading), M_PI, 0.1);
  EXPECT_DOUBLE_EQ(asked.poses[0].second.place, stated);
  EXPECT_TRUE(asked.previews.empty()) << "a pose needs no way";
}

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
  press(Qt::Key_Return);
  EXPECT_TRUE(asked.driven.empty()) << "Enter in a field only ends the field";
  press(Qt::Key_S, Qt::ControlModifier);
  ASSERT_EQ(asked.saved.size(), 1U);
  const RouteDraft mine = place->routeTool().draft();
  auto shelf = std::make_shared<RouteShelf>();
  shelf->serial = 1;
  shelf->route = RouteDraft{"other", true, {{{{0, 0}, 1.0}, 2.0}, {{{1, 1}, {}}, 0.0}}};
  state.place.shelf.set(shelf);
  refresh();
  EXPECT_EQ(place->routeTool().draft(), *shelf->route);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(place->routeTool().draft().points, mine.points);
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

void onMessage(QtMsgType type, const QMessageLogContext&, const QString& message) {
  if (message.contains("propagateSizeHints")) return;  // of the offscreen platform itself
  std::fprintf(stderr, "Qt: %s\n", qPrintable(message));
  if (type != QtDebugMsg && type != QtInfoMsg) ++qt_warnings;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("QT_QPA_PLATFORM", "offscreen", 1);
  const QTemporaryDir runtime;
  setenv("XDG_RUNTIME_DIR", qPrintable(runtime.path()), 1);
  ::testing::InitGoogleTest(&argc, argv);
  QApplication application(argc, argv);
  theme::apply(application);
  qInstallMessageHandler(onMessage);
  const int result = RUN_ALL_TESTS();
  if (qt_warnings > 0) std::fprintf(stderr, "%d Qt warnings\n", qt_warnings);
  return result != 0 || qt_warnings > 0 ? 1 : 0;
}
