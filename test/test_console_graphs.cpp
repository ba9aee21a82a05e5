// Graphs, buttons and the map's objects as the operator sees them, on Qt's offscreen platform.

#include <gtest/gtest.h>

#include <QApplication>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <cmath>
#include <cstdlib>

#include "gui/model/class_colours.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/helm.hpp"
#include "gui/view/drive_bar.hpp"
#include "gui/view/main_window.hpp"
#include "gui/view/map_canvas.hpp"
#include "gui/view/plot.hpp"
#include "gui/view/status_line.hpp"
#include "gui/view/stop_button.hpp"
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
  r.drive.wheel_radius = 0.1;
  return r;
}

void hover(QWidget& widget, QPointF place) {
  QMouseEvent move(QEvent::MouseMove, place, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&widget, &move);
}

void wheel(QWidget& widget, QPointF place, int delta, Qt::KeyboardModifiers keys = {}) {
  QWheelEvent event(place, widget.mapToGlobal(place.toPoint()), QPoint(), QPoint(0, delta),
                    Qt::NoButton, keys, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

/// A window with ten seconds of driving before `now`.
struct Window {
  Window() {
    LimitReading limit;
    limit.limit = 0.6;
    for (int i = 0; i <= 500; ++i) {
      const double t = now - 10.0 + 0.02 * i;
      limit.wanted = 0.4;
      limit.limited = limit.measured = i < 250 ? 0.4 : 0.2;
      limit.cause = i < 250 ? LimitCause::kFree : LimitCause::kObstacle;
      limit.sensor = "front";
      limit.distance = limit.obstacle_distance = 3.0 - 0.005 * i;
      limit.potential_distance = INFINITY;
      state.telemetry.limit(t, limit);
      state.telemetry.wheels(t, {{"left", -4.0}});
    }
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    speed = window.findChild<Plot*>("speed_plot");
    distance = window.findChild<Plot*>("distance_plot");
    window.refreshNow();
  }
  const Series& series(const QString& name) {
    for (const auto& one : speed->series()) {
      if (one.name == name) return one;
    }
    ADD_FAILURE() << "no series " << qPrintable(name);
    return speed->series().front();
  }
  double now = steadySeconds();
  ConsoleState state;
  RobotDescription description = robot();
  Helm helm{description.drive};
  MainWindow window{PanelContext{state, description, nullptr, &helm}, false};
  Plot* speed = nullptr;
  Plot* distance = nullptr;
};

TEST(Graphs, theCursorReadsTheValuesBelowItWhileTheyStream) {
  Window w;
  const QPointF early(w.speed->toPixel(w.now - 7.0, 0.0).x(), w.speed->field().center().y());
  hover(*w.speed, early);
  w.window.refreshNow();
  EXPECT_NEAR(w.series("measured").under_cursor, 0.4, 1e-9);
  EXPECT_NEAR(w.series("left").under_cursor, 0.4, 1e-9) << "wheel speed: rate times radius";
  EXPECT_TRUE(w.speed->readoutText().contains("measured 0.400 m/s"))
      << qPrintable(w.speed->readoutText());
  const QPointF late(w.speed->toPixel(w.now - 2.0, 0.0).x(), early.y());
  hover(*w.speed, late);
  EXPECT_NEAR(w.series("measured").under_cursor, 0.2, 1e-9);
  EXPECT_TRUE(w.speed->readoutText().contains("front ranger sees something"))
      << qPrintable(w.speed->readoutText());
}

TEST(Graphs, theCurveIsDrawnWhereItsValueSaysSo) {
  Window w;
  QToolButton* pause = nullptr;
  for (auto* button : w.window.findChildren<QToolButton*>()) {
    if (button->text() == "Pause") pause = button;
  }
  ASSERT_TRUE(pause);
  pause->click();  // what is drawn and what is asked are of one instant
  const QImage shot = w.speed->grab().toImage();
  const QPointF at = w.speed->toPixel(w.now - 2.0, 0.2);
  const QColor measured = w.series("measured").colour;
  const QColor wheel_colour = w.series("left").colour;
  bool found = false;
  for (int dy = -2; dy <= 2; ++dy) {
    const QColor pixel(shot.pixel(at.toPoint() + QPoint(0, dy)));
    found |= std::abs(pixel.red() - measured.red()) < 40 &&
             std::abs(pixel.blue() - measured.blue()) < 40;
  }
  EXPECT_TRUE(found);
  EXPECT_NE(measured, wheel_colour);
  // The band above tells the rule by its colour.
  const QPoint band(static_cast<int>(w.speed->toPixel(w.now - 0.3, 0).x()),
                    static_cast<int>(w.speed->field().top()) - 8);
  EXPECT_EQ(QColor(shot.pixel(band)), ruleColour(Rule::kObstacle));
}

TEST(Graphs, zoomsAboutTheCursorAndRunsLiveAgain) {
  Window w;
  const double span =
      w.speed->timeAt(w.speed->field().right()) - w.speed->timeAt(w.speed->field().left());
  EXPECT_NEAR(span, 30.0, 1e-6);
  const QPointF place(w.speed->field().center());
  QTest::mousePress(w.speed, Qt::LeftButton, Qt::NoModifier, place.toPoint());
  QMouseEvent drag(QEvent::MouseMove, place + QPointF(80, 0), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(w.speed, &drag);
  QTest::mouseRelease(w.speed, Qt::LeftButton, Qt::NoModifier, place.toPoint());
  const double before = w.speed->timeAt(place.x());
  wheel(*w.speed, place, 480);
  EXPECT_NEAR(w.speed->timeAt(place.x()), before, 1e-6) << "held: the time below the cursor stays";
  EXPECT_LT(w.speed->timeAt(place.x() + 100) - before, 100 * span / w.speed->field().width());
  const double right = w.distance->timeAt(w.distance->field().right());
  EXPECT_NEAR(right, w.speed->timeAt(w.speed->field().right()), 1e-6) << "one time for both";
  QTest::mouseDClick(w.speed, Qt::LeftButton, Qt::NoModifier, place.toPoint());
  EXPECT_NEAR(w.speed->timeAt(w.speed->field().right()) - w.speed->timeAt(w.speed->field().left()),
              30.0, 1e-6);
}

TEST(Graphs, theLegendSwitchesACurve) {
  Window w;
  EXPECT_TRUE(w.series("wanted").shown);
  const QRectF box = w.speed->legendBox("wanted");
  ASSERT_FALSE(box.isEmpty());
  QTest::mouseClick(w.speed, Qt::LeftButton, Qt::NoModifier, box.center().toPoint());
  EXPECT_FALSE(w.series("wanted").shown);
  QTest::mouseClick(w.speed, Qt::LeftButton, Qt::NoModifier, box.center().toPoint());
  EXPECT_TRUE(w.series("wanted").shown);
}

TEST(Graphs, pauseHoldsThePictureWhileSamplesAreKept) {
  Window w;
  QTest::keyClick(&w.window, Qt::Key_P);
  const double right = w.speed->timeAt(w.speed->field().right());
  LimitReading limit;
  limit.wanted = limit.limited = limit.measured = 0.1;
  w.state.telemetry.limit(steadySeconds() + 0.001, limit);
  QTest::qWait(100);
  w.window.refreshNow();
  EXPECT_EQ(w.speed->timeAt(w.speed->field().right()), right);
  QTest::keyClick(&w.window, Qt::Key_P);
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return w.speed->timeAt(w.speed->field().right()) > right; }, 60000));
  EXPECT_NEAR(w.series("measured").newest, 0.1, 1e-6);
}

std::shared_ptr<const ObjectsPicture> oneObject(InTheWay relevance, bool remembered, float z) {
  auto picture = std::make_shared<ObjectsPicture>();
  picture->objects.push_back(
      {1.5F, 0.5F, 0.2F, CellClass::kObstacle, true, relevance, z, remembered});
  return picture;
}

/// Colour at a quarter of the object's edge from its middle, off its cross.
QColor drawnObject(InTheWay relevance, bool remembered, std::optional<HeightBand> band = {}) {
  const RobotDescription r = robot();
  MapCanvas map(r);
  map.resize(600, 600);
  map.show();
  map.setJudged(true);
  map.setHeightBand(band);
  map.setObjects(oneObject(relevance, remembered, 0.4F));
  const QImage shot = map.grab().toImage();
  return QColor(shot.pixel(map.view().toPixel(1.5 + 0.04, 0.5).toPoint()));
}

TEST(MapObjects, areColouredByWhetherTheyAreInTheWay) {
  for (const auto relevance : {InTheWay::kOther, InTheWay::kPotential, InTheWay::kYes}) {
    EXPECT_EQ(drawnObject(relevance, false), inTheWayColour(relevance));
    EXPECT_NE(drawnObject(relevance, true), inTheWayColour(relevance)) << "remembered: hollow";
  }
}

TEST(MapObjects, atTheChosenHeightAreViolet) {
  EXPECT_EQ(drawnObject(InTheWay::kOther, false, HeightBand{0.3, 0.5}), atHeightColour());
  EXPECT_EQ(drawnObject(InTheWay::kOther, false, HeightBand{0.5, 0.7}),
            inTheWayColour(InTheWay::kOther));
}

TEST(HoldButton, wantsToBeHeldThroughAutorepeat) {
  HoldButton button;
  button.show("Hold to arm", "F9", true);
  QSignalSpy confirmed(&button, &HoldButton::confirmed);
  QTest::mouseClick(&button, Qt::LeftButton);
  QTest::qWait(HoldButton::kHold + 100);
  EXPECT_EQ(confirmed.count(), 0);
  button.keyDown(false);
  for (int i = 0; i < 5; ++i) {
    QTest::qWait(20);
    button.keyUp();  // X repeats: released and pressed at once
    button.keyDown(false);
  }
  EXPECT_TRUE(confirmed.wait(60000));
  button.keyUp();
  button.show("Armed", "ready", false);
  button.keyDown(false);
  QTest::qWait(HoldButton::kHold + 100);
  EXPECT_EQ(confirmed.count(), 1);
}

TEST(DriveBar, isInSightAndSpeaks) {
  Window w;
  ASSERT_TRUE(w.window.driveBar());
  EXPECT_TRUE(w.window.driveBar()->isVisible());
  auto* stop = w.window.findChild<StopButton*>("stop_button");
  ASSERT_TRUE(stop && stop->isVisible());
  EXPECT_EQ(w.window.driveBar()->words().headline, "No robot: no ROS master answers");
  LinkStatus link;
  link.phase = LinkPhase::kConnected;
  w.state.link.set(link);
  StopReading reading;
  reading.cause = StopCause::kNotArmed;
  reading.can_arm = true;
  w.state.gate.arrived(steadySeconds(), 1, "gate", "/stop_state");
  w.state.gate.deliver(
      Checked<std::shared_ptr<const StopReading>>::of(std::make_shared<const StopReading>(reading)),
      steadySeconds(), 0.0);
  w.window.refreshNow();
  EXPECT_EQ(w.window.driveBar()->words().headline, "Not armed: the robot stands");
  EXPECT_TRUE(w.window.findChild<HoldButton*>("arm_button")->isEnabled());
  QTest::mousePress(stop, Qt::LeftButton);
  EXPECT_TRUE(w.helm.stopped());
}

TEST(DriveBar, spaceStopsWhateverHasTheFocus) {
  Window w;
  auto* button = w.window.findChild<QToolButton*>();
  QTest::keyClick(button, Qt::Key_Space);
  EXPECT_TRUE(w.helm.stopped());
  w.helm.release(w.helm.stops());
  QTest::keyClick(&w.window, Qt::Key_Escape);
  EXPECT_TRUE(w.helm.stopped());
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
