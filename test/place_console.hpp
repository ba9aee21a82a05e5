#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QMouseEvent>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gui/model/clock.hpp"
#include "gui/model/conversions_place.hpp"
#include "gui/model/helm.hpp"
#include "gui/view/main_window.hpp"
#include "gui/view/place_view.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

// What the tests of the map that stays in place need: the window on Qt's offscreen platform, before
// a robot that keeps what it is asked.

/// Keeps what was asked.
struct Asked : PlaceAsks {
  std::uint32_t id = 0;
  std::vector<PlaceGoal> previews, goals;
  std::vector<std::pair<Pose2, PoseSpread>> poses;
  std::vector<RouteDraft> driven, saved;
  std::vector<std::string> loaded;
  std::vector<TaskCall> calls;
  std::vector<std::optional<Pose2>> starts;  ///< of the previews
  std::vector<std::string> maps;             ///< "save NAME", "load NAME", "clear"
  void preview(std::uint32_t i, const PlaceGoal& goal, const std::optional<Pose2>& from) override {
    id = i;
    previews.push_back(goal);
    starts.push_back(from);
  }
  void goTo(const PlaceGoal& goal) override { goals.push_back(goal); }
  void setPose(const Pose2& pose, const PoseSpread& spread) override {
    poses.emplace_back(pose, spread);
  }
  void driveRoute(const RouteDraft& draft) override { driven.push_back(draft); }
  void saveRoute(const RouteDraft& draft) override { saved.push_back(draft); }
  void loadRoute(const std::string& name) override { loaded.push_back(name); }
  void task(TaskCall call) override { calls.push_back(call); }
  void saveMap(const std::string& name) override { maps.push_back("save " + name); }
  void loadMap(const std::string& name) override { maps.push_back("load " + name); }
  void clearMap() override { maps.emplace_back("clear"); }
};

inline RobotDescription platform() {
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
        PanelContext{state, robot, nullptr, &helm,
                     [this](StopSerial stops) { armed.push_back(stops); },
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
  /// The robot answers with its routes, and with one of them.
  void shelve(const std::optional<RouteDraft>& route, const std::vector<std::string>& files) {
    const auto before = state.place.shelf.get();
    state.place.shelf.set(
        std::make_shared<RouteShelf>(RouteShelf{before ? before->serial + 1 : 1, route, files}));
    refresh();
  }
  /// As long as something must be in sight before it is sent.
  void lookAtIt() {
    refresh();
    QTest::qWait(static_cast<int>(1000.0 * AimTool::kLook) + 50);
  }
  void answer(bool way) {
    Preview preview;
    preview.id = asked.id;
    preview.answered = true;
    preview.found = way;
    preview.why = way ? "" : "something stands there";
    preview.path.points = {{0, 0}, {1, 0.5}, {2, 1}};
    preview.path.length = 2.3;
    preview.time = 7.0;
    if (!way) preview.nearest = Eigen::Vector2d(1.5, 0.5);
    state.place.preview.set(std::make_shared<const Preview>(preview));
    refresh();
    lookAtIt();
  }

  ConsoleState state;
  const RobotDescription robot = platform();
  Helm helm{robot.drive};
  Asked asked;
  std::vector<StopSerial> armed;
  std::unique_ptr<MainWindow> window;
  PlaceView* place = nullptr;
  PlaceCanvas* canvas = nullptr;
};

inline int qt_warnings = 0;

inline void onMessage(QtMsgType type, const QMessageLogContext&, const QString& message) {
  // Of the offscreen platform itself.
  if (message.contains("propagateSizeHints") || message.contains("plugin does not support")) return;
  std::fprintf(stderr, "Qt: %s\n", qPrintable(message));
  if (type != QtDebugMsg && type != QtInfoMsg) ++qt_warnings;
}

/// main() of such a test; fails on any warning of Qt.
inline int runPlaceTests(int argc, char** argv) {
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

}  // namespace pilothouse::gui
