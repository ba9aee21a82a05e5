// Panels as the operator sees them, on Qt's offscreen platform: readouts, pixels, wheel, registry.

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "gui/model/class_colours.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/helm.hpp"
#include "gui/view/header_strip.hpp"
#include "gui/view/main_window.hpp"
#include "gui/view/map_canvas.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/options.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/picture_canvas.hpp"
#include "gui/view/status_line.hpp"
#include "gui/view/theme.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

int qt_warnings = 0;

RobotDescription robot() {
  RobotDescription r;
  r.name = "platform";
  r.title = "Platform";
  r.footprint = {{{0.25, 0.20}}, {{-0.25, 0.20}}, {{-0.25, -0.20}}, {{0.25, -0.20}}};
  return r;
}

std::shared_ptr<const DepthPicture> ramp(int width, int height) {
  auto picture = std::make_shared<DepthPicture>();
  picture->image = QImage(width, height, QImage::Format_RGB32);
  picture->span = {0.5F, 4.0F};
  const DepthRamp colours;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const float metres = 1.0F + 0.01F * static_cast<float>(column);
      picture->metres.push_back(metres);
      picture->image.setPixel(column, row, colours.colour(metres, picture->span));
    }
  }
  return picture;
}

std::shared_ptr<const FloorPicture> floorOf(CellClass all) {
  auto picture = std::make_shared<FloorPicture>();
  picture->geometry = {0.5F, -1.0F, 0.1F, 20, 20};
  picture->classes.assign(400, all);
  picture->heights.assign(400, 0.012F);
  picture->deviations.assign(400, 0.003F);
  picture->image = QImage(20, 20, QImage::Format_ARGB32);
  picture->image.fill(QColor::fromRgba(classColour(all)));
  return picture;
}

FeedState fresh() {
  FeedState state;
  state.ever = true;
  state.rate_hz = 10.0;
  state.age_s = 0.1;
  return state;
}

template <class Picture>
void deliver(Feed<Picture>& feed, std::shared_ptr<const Picture> picture, double at) {
  feed.arrived(at, 1, "test", "/topic");
  feed.deliver(Checked<std::shared_ptr<const Picture>>::of(std::move(picture)), at, 0.0);
}

void hover(QWidget& widget, QPointF place) {
  QMouseEvent move(QEvent::MouseMove, place, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&widget, &move);
}

void wheel(QWidget& widget, QPointF place, int delta) {
#if QT_VERSION >= QT_VERSION_CHECK(5, 12, 0)
  QWheelEvent event(place, widget.mapToGlobal(place.toPoint()), QPoint(), QPoint(0, delta),
                    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
#endif
  QApplication::sendEvent(&widget, &event);
}

TEST(Registry, findsEveryPanelOnceAndInOrder) {
  std::vector<std::string> ids;
  for (const auto& entry : panelRegistry()) {
    ids.push_back(entry.id);
    EXPECT_FALSE(entry.title.isEmpty());
    EXPECT_TRUE(entry.make);
  }
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  ASSERT_GE(ids.size(), 3U);
  EXPECT_EQ(ids[0], "map");
  for (const char* id : {"depth", "colour", "scene"}) {
    EXPECT_EQ(std::count(ids.begin(), ids.end(), id), 1) << id;
  }
}

TEST(DepthPanel, cursorReadsMetresOfThePixelBelowIt) {
  ConsoleState state;
  const RobotDescription r = robot();
  MainWindow window({state, r, nullptr}, false);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  deliver<DepthPicture>(state.depth, ramp(64, 48), steadySeconds());
  window.refreshNow();
  auto* canvas = window.findChild<PictureCanvas*>("depth_canvas");
  ASSERT_TRUE(canvas);
  const QRectF where = canvas->pictureRect();
  hover(*canvas, {where.left() + (40.5 / 64) * where.width(), where.top() + where.height() * 0.5});
  EXPECT_EQ(canvas->readoutText(), "1.400 m   pixel 40, 24");
  // The colour on the screen reads back to the same distance.
  const QImage shot = canvas->grab().toImage();
  const QPoint at = QPointF(where.left() + (20.5 / 64) * where.width(), where.top() + 10).toPoint();
  EXPECT_NEAR(DepthRamp().metres(shot.pixel(at), {0.5F, 4.0F}), 1.2F, 0.02F);
  hover(*canvas, {-5, -5});
  EXPECT_EQ(canvas->readoutText(), "");
}

TEST(MapCanvas, theRobotStandsWhereTheMapSays) {
  const RobotDescription r = robot();
  MapCanvas map(r);
  map.resize(600, 500);
  map.show();
  map.setFloor(floorOf(CellClass::kFloor));
  map.setState(fresh(), {});
  const QImage shot = map.grab().toImage();
  const auto colourAt = [&](double x, double y) {
    return QColor(shot.pixel(map.view().toPixel(x, y).toPoint()));
  };
  EXPECT_EQ(colourAt(-0.1, 0.1), robotColour());
  EXPECT_EQ(colourAt(-0.22, -0.17), robotColour()) << "to scale: its corner too";
  EXPECT_NE(colourAt(-0.1, 0.24), robotColour());
  EXPECT_NE(colourAt(-0.29, 0.0), robotColour());
}

TEST(MapCanvas, cellsHaveTheirClassColourAndReadout) {
  const RobotDescription r = robot();
  MapCanvas map(r);
  map.resize(600, 500);
  map.show();
  auto floor = std::make_shared<FloorPicture>(*floorOf(CellClass::kFloor));
  const int ix = 12, iy = 16;  // ahead, to the left
  floor->classes[floor->geometry.index(ix, iy)] = CellClass::kObstacle;
  floor->image.setPixel(19 - iy, 19 - ix, classColour(CellClass::kObstacle));
  map.setFloor(floor);
  map.setState(fresh(), {});
  const double x = double(floor->geometry.centreX(ix));
  const double y = double(floor->geometry.centreY(iy));
  const QImage shot = map.grab().toImage();
  EXPECT_EQ(shot.pixel((map.view().toPixel(x, y) + QPointF(3, 3)).toPoint()),
            classColour(CellClass::kObstacle));
  hover(map, map.view().toPixel(x, y));
  EXPECT_EQ(map.readoutText(),
            "1.75 m ahead   0.65 m left   obstacle   height 1.2 cm   deviation 3.0 mm");
  hover(map, map.view().toPixel(3.1, -0.5));
  EXPECT_EQ(map.readoutText(), "3.10 m ahead   0.50 m right");
}

TEST(MapCanvas, wheelKeepsThePlaceUnderTheCursor) {
  const RobotDescription r = robot();
  MapCanvas map(r);
  map.resize(600, 500);
  map.show();
  const QPointF cursor(420, 130);
  const QPointF before = map.view().toMetres(cursor);
  const double scale = map.view().scale();
  wheel(map, cursor, 240);
  EXPECT_GT(map.view().scale(), scale * 1.2);
  EXPECT_NEAR(map.view().toMetres(cursor).x(), before.x(), 1e-9);
  EXPECT_NEAR(map.view().toMetres(cursor).y(), before.y(), 1e-9);
}

TEST(MapCanvas, dragPansAndDoubleClickFitsAgain) {
  const RobotDescription r = robot();
  MapCanvas map(r);
  map.resize(600, 500);
  map.show();
  const QPointF fitted = map.view().toPixel(1, 0);
  QTest::mousePress(&map, Qt::LeftButton, Qt::NoModifier, {300, 200});
  QMouseEvent move(QEvent::MouseMove, QPointF(340, 230), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&map, &move);
  QTest::mouseRelease(&map, Qt::LeftButton, Qt::NoModifier, {340, 230});
  EXPECT_NEAR(map.view().toPixel(1, 0).x(), fitted.x() + 40, 1e-6);
  EXPECT_NEAR(map.view().toPixel(1, 0).y(), fitted.y() + 30, 1e-6);
  QTest::mouseDClick(&map, Qt::LeftButton, Qt::NoModifier, {300, 200});
  EXPECT_NEAR(map.view().toPixel(1, 0).x(), fitted.x(), 1e-6);
}

TEST(MapCanvas, aStaleMapIsNeverShownAsLive) {
  const RobotDescription r = robot();
  MapCanvas map(r);
  map.resize(600, 500);
  map.show();
  map.setFloor(floorOf(CellClass::kFloor));
  map.setState(fresh(), {});
  const QPoint cell = map.view().toPixel(1.73, 0.63).toPoint();
  EXPECT_EQ(map.grab().toImage().pixel(cell), classColour(CellClass::kFloor));
  FeedState stale = fresh();
  stale.age_s = 5.0;
  map.setState(stale, {});
  EXPECT_NE(map.grab().toImage().pixel(cell), classColour(CellClass::kFloor));
}

TEST(HeaderStrip, tellsRateAgeAndDrops) {
  HeaderStrip strip("Depth");
  EXPECT_EQ(strip.figures(), "no data");
  FeedState state = fresh();
  state.drops = 4;
  strip.show(state);
  EXPECT_EQ(strip.figures(), "10.0 Hz   age 0.1 s   4 dropped");
}

TEST(MainWindow, namesWhatIsMissingAndIsCompleteWithAllPictures) {
  ConsoleState state;
  LinkStatus link;
  link.phase = LinkPhase::kConnected;
  link.master_uri = "http://localhost:11311";
  state.link.set(link);
  const RobotDescription r = robot();
  MainWindow window({state, r, nullptr}, false);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  window.refreshNow();
  EXPECT_TRUE(
      window.statusLine()->sentence().contains("o depth: nobody publishes camera/depth/image_rect"))
      << qPrintable(window.statusLine()->sentence());
  EXPECT_FALSE(window.complete());
  deliver<DepthPicture>(state.depth, ramp(64, 48), 1.0);
  deliver<FloorPicture>(state.floor, floorOf(CellClass::kFloor), 1.0);
  auto colour = std::make_shared<ColourPicture>();
  colour->image = QImage(64, 48, QImage::Format_RGB32);
  deliver<ColourPicture>(state.colour, colour, 1.0);
  window.refreshNow();
  EXPECT_TRUE(window.complete());
}

TEST(MainWindow, everyKeyIsUniqueAndResetBringsPanelsBack) {
  ConsoleState state;
  const RobotDescription r = robot();
  MainWindow window({state, r, nullptr}, false);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  std::set<QString> keys;
  for (const auto* action : window.findChildren<QAction*>()) {
    for (const auto& key : action->shortcuts()) {
      EXPECT_TRUE(keys.insert(key.toString()).second) << qPrintable(key.toString());
    }
  }
  EXPECT_GE(keys.size(), 8U);
  auto* canvas = window.findChild<QWidget*>("depth_canvas");
  ASSERT_TRUE(canvas && canvas->isVisible());
  QTest::keyClick(&window, Qt::Key_3, Qt::ControlModifier);
  EXPECT_FALSE(canvas->isVisible()) << "the third panel is the depth picture";
  QTest::keyClick(&window, Qt::Key_0, Qt::ControlModifier);
  EXPECT_TRUE(canvas->isVisible());
}

TEST(MainWindow, aPanelThatCannotBeHadLeavesADisabledEntryWithTheReason) {
  ConsoleState state;
  const RobotDescription r = robot();
  MainWindow window({state, r, nullptr}, false);
  const QAction* entry = nullptr;
  for (const auto* action : window.findChildren<QAction*>()) {
    if (action->text().startsWith("3D view")) entry = action;
  }
  ASSERT_TRUE(entry);
  // No library lies beside this test's program, and the offscreen platform could not draw it.
  EXPECT_FALSE(entry->isEnabled());
  EXPECT_TRUE(entry->text().contains("built without rviz") || entry->text().contains("X11"));
}

TEST(MainWindow, opensAsItWasClosed) {
  const QTemporaryDir folder;
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder.path());
  ConsoleState state;
  const RobotDescription r = robot();
  QList<QRect> before;
  QRect place;
  const auto docks = [](const MainWindow& window) {
    QList<QRect> places;
    for (const auto* dock : window.findChildren<QDockWidget*>()) places << dock->geometry();
    return places;
  };
  for (int round = 0; round < 3; ++round) {
    MainWindow window({state, r, nullptr}, true);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    QTest::qWait(20);
    if (round == 0) place = window.geometry();
    EXPECT_EQ(window.geometry(), place) << round;
    if (round == 0) before = docks(window);
    EXPECT_EQ(docks(window), before) << round;
    window.close();
  }
}

TEST(MainWindow, fitsASmallScreen) {
  ConsoleState state;
  const RobotDescription r = robot();
  Helm helm(r.drive);
  MainWindow window({state, r, nullptr, &helm}, false);
  // 1280x720 at 200 %.
  EXPECT_LE(window.minimumSizeHint().width(), 640);
  EXPECT_LE(window.minimumSizeHint().height(), 360);
}

// What others send in plenty must not hold the window up.
TEST(StatusLine, itsDrawingTakesNoLongerTheMoreThereIsToTell) {
  StatusLine line;
  line.resize(1200, 30);
  const auto quickest = [&](int complaints) {
    Situation situation;
    situation.link.phase = LinkPhase::kConnected;
    for (int i = 0; i < complaints; ++i) {
      situation.complaints.push_back({"joint " + std::to_string(i), std::string(300, 'y'), true});
    }
    line.show(situation);
    line.grab();
    double best = 1e9;
    for (int i = 0; i < 7; ++i) {
      const double began = steadySeconds();
      line.grab();
      best = std::min(best, steadySeconds() - began);
    }
    return best;
  };
  EXPECT_LT(quickest(640), 6.0 * quickest(40)) << "256 times were it quadratic";
}

TEST(Options, refusalsAreOneLine) {
  const auto reason = [](const QStringList& words) {
    const auto options = parseOptions(words);
    return options ? std::string("accepted") : options.reason();
  };
  EXPECT_EQ(reason({"--nonsense"}), "unknown option '--nonsense' (--help lists them)");
  EXPECT_EQ(reason({"--robot", "nobody"}), "--robot 'nobody': no such robot or file");
  EXPECT_EQ(reason({"--robot"}), "--robot needs a name or a file");
  EXPECT_EQ(reason({"--screenshot", "/nowhere/x.png"}), "--screenshot: cannot write into /nowhere");
  EXPECT_EQ(reason({"--screenshot", "/tmp/x.png", "--after", "soon"}),
            "--after 'soon': expected seconds from 0 to 86400");
  EXPECT_EQ(reason({"--after", "3"}), "--after and --when-complete need --screenshot FILE");
  EXPECT_EQ(reason({"camera/depth/image_rect:=/x", "__name:=y"}), "accepted");
}

void onMessage(QtMsgType type, const QMessageLogContext&, const QString& message) {
  std::fprintf(stderr, "Qt: %s\n", qPrintable(message));
  // The offscreen platform's own, about every window.
  if (message.contains("propagateSizeHints")) return;
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
