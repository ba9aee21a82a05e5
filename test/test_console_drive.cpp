// Stopping, arming and driving from the whole console: real keys from xdotool, a window manager, a
// real master, a robot of its own process; what counts is the message that was published. Runs
// under test/with_display. Arguments: the program fake_robot.

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>

#include <QApplication>
#include <QDoubleSpinBox>
#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "gui/view/drive_bar.hpp"
#include "gui/view/place_view.hpp"
#include "gui/view/stop_button.hpp"
#include "gui/view/theme.hpp"
#include "test/console_bridge.hpp"
#include "test/free_port.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

QString robot_program, own_program;
int qt_warnings = 0;

/// A service that does not answer as long as this lives.
template <class Service>
class HangingService {
 public:
  explicit HangingService(const char* name) : spinner_(1, &queue_) {
    node_.setCallbackQueue(&queue_);
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    server_ = node_.advertiseService<Request, Response>(name, [this](Request&, Response&) {
      asked_ = true;
      while (!ending_) QThread::msleep(5);
      return true;
    });
    spinner_.start();
  }
  ~HangingService() {
    ending_ = true;
    spinner_.stop();
  }
  bool asked() const { return asked_; }

 private:
  std::atomic<bool> asked_{false}, ending_{false};
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_;
};

class ConsoleDrive : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    bridge = new Bridge;
    ASSERT_TRUE(bridge->watcher) << "no XInput 2: a busy window would delay the stop key";
    ASSERT_TRUE(
        bridge->wait([] { return bridge->state.link.get().phase == LinkPhase::kConnected; }));
    bridge->recorder = std::make_unique<Recorder>();
    ASSERT_TRUE(bridge->gateIs(GatePhase::kStopped)) << "the gate starts not armed";
    ASSERT_TRUE(bridge->wait([] { return !bridge->recorder->beats(0.0).empty(); }));
  }
  void SetUp() override { bridge->makeReady(); }
  void TearDown() override {
    xdotool("keyup w keyup Up keyup space");
    EXPECT_TRUE(bridge->wait([&] {  // it may come to rest first
      const auto drives = bridge->recorder->drives(0.0);
      return drives.empty() || bridge->recorder->beats(drives.back().at).size() >= 4;
    }));
    bridge->expectSilence(3);
  }
  static Bridge* bridge;
};
Bridge* ConsoleDrive::bridge = nullptr;

TEST_F(ConsoleDrive, aHeldKeyDrivesAt25HzAndItsReleaseIsOneZeroThenSilence) {
  const double since = steadySeconds();
  bridge->expectSilence(5);
  xdotool("keydown w");
  ASSERT_TRUE(bridge->drives(since, 75));  // 3 s: X repeats the key all along
  EXPECT_EQ(zeros(bridge->recorder->drives(since)), 0) << "autorepeat must not stutter";
  xdotool("keyup w");
  ASSERT_TRUE(bridge->ended(since));
  bridge->expectSilence(10);
  auto all = bridge->recorder->drives(since);
  // One, and perhaps some more until the limiter's report says that the robot stands.
  EXPECT_LE(zeros(all), 8);
  while (all.back().command.zero()) all.pop_back();
  EXPECT_EQ(zeros(all), 0);
  const double rate = static_cast<double>(all.size() - 1) / (all.back().at - all.front().at);
  EXPECT_NEAR(rate, 25.0, 2.0);
  EXPECT_GT(all.front().command.vx, 0.0);
}

TEST_F(ConsoleDrive, whileDrivenTheSignOfLifeSaysSo) {
  const double since = steadySeconds();
  xdotool("keydown Up");
  ASSERT_TRUE(bridge->wait([&] {
    const auto beats = bridge->recorder->beats(since);
    return !beats.empty() && beats.back().message.driving;
  }));
  const auto beats = bridge->recorder->beats(since);
  EXPECT_FALSE(beats.back().message.name.empty());
  EXPECT_GT(beats.back().message.gate_beat, 0U) << "the gate's beat is echoed";
  xdotool("keyup Up");
  ASSERT_TRUE(bridge->wait([&] { return !bridge->recorder->beats(since).back().message.driving; }));
}

TEST_F(ConsoleDrive, aLostFocusStopsAlthoughTheReleaseNeverArrives) {
  Child other(own_program, {"--other-window"});
  const double since = steadySeconds();
  ASSERT_TRUE(bridge->wait([&] { return xdotool("search --name OtherWindow >/dev/null") == 0; }));
  // A new window takes the keyboard whenever it is ready: it has had it before this one gets it.
  xdotool("search --onlyvisible --sync --name OtherWindow windowactivate --sync");
  bridge->focus();
  // What is pressed before the window knows that it has the keyboard does not count.
  const auto driven = [&] { return bridge->recorder->drives(since).size() >= 10; };
  for (int i = 0; i < 5 && !driven(); ++i) {
    xdotool("keyup w");
    xdotool("keydown w");
    const double until = steadySeconds() + 2.0;
    bridge->wait([&] { return driven() || steadySeconds() > until; });
  }
  ASSERT_TRUE(driven());
  xdotool("search --name OtherWindow windowactivate --sync");
  ASSERT_TRUE(bridge->ended(since));
  bridge->expectSilence(10);
  bridge->focus();  // the finger never left the key
  bridge->expectSilence(10);
}

TEST_F(ConsoleDrive, minimisingStops) {
  const double since = steadySeconds();
  xdotool("keydown w");
  ASSERT_TRUE(bridge->drives(since, 10));
  xdotool(QString("windowminimize --sync %1").arg(bridge->window->winId()));
  ASSERT_TRUE(bridge->ended(since));
  xdotool("keyup w");
}

TEST_F(ConsoleDrive, theStopKeyWorksWhileTheWindowHangs) {
  double pressed = 0.0;
  const double since = steadySeconds();
  std::thread presser([&] {
    QThread::msleep(300);  // well within the hang
    xdotool("key space");
    pressed = steadySeconds();
  });
  QThread::msleep(2000);  // the GUI thread hangs, on purpose
  const double back = steadySeconds();
  presser.join();
  const auto beats = bridge->recorder->beats(since);
  const auto first =
      std::find_if(beats.begin(), beats.end(), [](const auto& beat) { return beat.message.stop; });
  ASSERT_NE(first, beats.end());
  EXPECT_LT(first->at, back) << "published while the window hung";
  EXPECT_LT(first->at - pressed, 0.1);
  EXPECT_TRUE(bridge->helm.stopped());
}

TEST_F(ConsoleDrive, theStopButtonWorksWhileTheWindowHangsAndBesideAnOpenMenu) {
  auto* stop = bridge->window->findChild<StopButton*>("stop_button");
  const QPoint at = stop->mapToGlobal(stop->rect().center());
  QTest::qWait(200);  // the watcher has heard where it is
  xdotool(QString("mousemove --sync %1 %2").arg(at.x()).arg(at.y()));
  double since = steadySeconds();
  const StopSerial stops = bridge->helm.stops();
  std::thread presser([&] {
    QThread::msleep(300);  // well within the hang
    xdotool("click 1");
  });
  QThread::msleep(2000);  // the GUI thread hangs, on purpose
  const double back = steadySeconds();
  presser.join();
  const auto beats = bridge->recorder->beats(since);
  const auto first =
      std::find_if(beats.begin(), beats.end(), [](const auto& beat) { return beat.message.stop; });
  ASSERT_NE(first, beats.end());
  EXPECT_LT(first->at, back) << "published while the window hung";
  // The window hears of it late: that is a press too.
  ASSERT_TRUE(bridge->wait([&] { return bridge->helm.stops() >= stops + 2; }));
  bridge->makeReady();
  since = steadySeconds();
  xdotool("key alt+c");
  ASSERT_TRUE(bridge->wait([] { return QApplication::activePopupWidget() != nullptr; }));
  const QRect menu = QApplication::activePopupWidget()->geometry();
  EXPECT_FALSE(menu.intersects({stop->mapToGlobal(QPoint(0, 0)), stop->size()}));
  xdotool("click 1");
  EXPECT_TRUE(bridge->stopPublished(since));
  QTest::qWait(100);
  if (auto* popup = QApplication::activePopupWidget()) popup->close();
}

TEST_F(ConsoleDrive, aWindowThatHangsEndsDrivingByHandButNotTheSignOfLife) {
  const double since = steadySeconds();
  xdotool("keydown w");
  ASSERT_TRUE(bridge->drives(since, 10));
  const double hung = steadySeconds();
  QThread::msleep(2000);  // the GUI thread hangs, on purpose
  const double back = steadySeconds();
  const auto drives = bridge->recorder->drives(hung);
  ASSERT_FALSE(drives.empty());
  EXPECT_TRUE(drives.back().command.zero());
  EXPECT_LE(zeros(drives), 8);
  EXPECT_LT(drives.back().at, back - 0.5);
  const auto beats = bridge->recorder->beats(hung);
  EXPECT_GE(beats.size(), 30U);
  for (const auto& beat : beats) EXPECT_FALSE(beat.message.stop);
  bridge->expectSilence(5);
}

TEST_F(ConsoleDrive, theStopKeyIsLatchedUntilArmedByHoldingF9) {
  const double since = steadySeconds();
  xdotool("key Escape");
  ASSERT_TRUE(bridge->stopPublished(since));
  ASSERT_TRUE(bridge->gateIs(GatePhase::kStopped));
  xdotool("keydown w");
  bridge->expectSilence(5);
  xdotool("keyup w");
  xdotool("key F9");  // a tap is no confirmation
  bridge->expectSilence(5);
  EXPECT_EQ(bridge->gateNow(), GatePhase::kStopped);
  xdotool("keydown F9");
  ASSERT_TRUE(bridge->wait([&] { return bridge->gateNow() != GatePhase::kStopped; }));
  xdotool("keyup F9");
  EXPECT_FALSE(bridge->recorder->beats(since).back().message.stop);
}

// A floor nodelet that never answers holds up neither arming nor the link.
TEST_F(ConsoleDrive, armsWhileTheFloorNodeletHangs) {
  HangingService<dynamic_reconfigure::Reconfigure> floor("floor/set_parameters");
  bridge->link.askFloor("improved", false);
  ASSERT_TRUE(bridge->wait([&] { return floor.asked(); }));
  const double since = steadySeconds();
  xdotool("key space");
  ASSERT_TRUE(bridge->stopPublished(since));
  ASSERT_TRUE(bridge->gateIs(GatePhase::kStopped));
  bridge->link.askArm(bridge->helm.stops());
  EXPECT_TRUE(bridge->wait([&] { return bridge->gateNow() != GatePhase::kStopped; }));
}

TEST_F(ConsoleDrive, theButtonsPublishWhatTheySay) {
  auto* stop = bridge->window->findChild<StopButton*>("stop_button");
  auto* arm = bridge->window->findChild<HoldButton*>("arm_button");
  ASSERT_TRUE(stop && arm);
  const double since = steadySeconds();
  QTest::mousePress(stop, Qt::LeftButton);  // acts before it is released
  ASSERT_TRUE(bridge->stopPublished(since));
  QTest::mouseRelease(stop, Qt::LeftButton);
  ASSERT_TRUE(bridge->gateIs(GatePhase::kStopped));
  ASSERT_TRUE(bridge->wait([&] { return arm->isEnabled(); }));
  QTest::mouseClick(arm, Qt::LeftButton);
  bridge->expectSilence(4);
  EXPECT_EQ(bridge->gateNow(), GatePhase::kStopped) << "a click is no confirmation";
  QTest::mousePress(arm, Qt::LeftButton);
  ASSERT_TRUE(bridge->wait([&] { return bridge->gateNow() != GatePhase::kStopped; }));
  QTest::mouseRelease(arm, Qt::LeftButton);
}

TEST_F(ConsoleDrive, keysInAFieldDoNotDriveButTheStopKeyStops) {
  QTest::keyClick(bridge->window.get(), Qt::Key_H);
  auto* band = bridge->window->findChild<QWidget*>("height_band");
  ASSERT_TRUE(band);
  auto* field = band->findChild<QDoubleSpinBox*>();
  ASSERT_TRUE(field);
  ASSERT_TRUE(bridge->wait([&] { return field->isVisible(); }));
  field->setFocus();
  ASSERT_TRUE(bridge->wait([&] { return field->hasFocus(); }));
  const double since = steadySeconds();
  xdotool("keydown Up");
  bridge->expectSilence(8);
  xdotool("keyup Up");
  EXPECT_FALSE(bridge->recorder->beats(since).back().message.stop);
  xdotool("key space");
  ASSERT_TRUE(bridge->stopPublished(since));
  field->clearFocus();
  QTest::keyClick(bridge->window.get(), Qt::Key_H);
}

// With real keys, repeated by the server, and read beside the window as well.
TEST_F(ConsoleDrive, arrowsAimWithAToolInHandAndNeverDriveOnWhenItIsLaidDown) {
  xdotool("key g");
  ASSERT_TRUE(bridge->wait([&] { return bridge->helm.arrowsAim(); }));
  auto& aim = bridge->window->findChild<PlaceView*>()->goalTool();
  xdotool("key Return");
  ASSERT_TRUE(bridge->wait([&] { return aim.aim().goal().has_value(); }));
  const Eigen::Vector2d before = aim.aim().goal()->place;
  const double since = steadySeconds();
  xdotool("keydown Up");
  ASSERT_TRUE(bridge->wait([&] { return aim.aim().goal()->place.y() > before.y(); }));
  xdotool("key g");
  ASSERT_TRUE(bridge->wait([&] { return !bridge->helm.arrowsAim(); }));
  bridge->expectSilence(8);
  xdotool("keyup Up");
  EXPECT_TRUE(bridge->recorder->drives(since).empty());
  const double anew = steadySeconds();
  xdotool("keydown Up");
  EXPECT_TRUE(bridge->drives(anew, 3)) << "pressed anew it drives";
  xdotool("key g");  // a tool taken up while driven by hand: the arrow drives on
  ASSERT_TRUE(bridge->wait([&] { return bridge->window->findChild<PlaceView*>()->isVisible(); }));
  const double later = steadySeconds();
  EXPECT_TRUE(bridge->drives(later, 5));
  EXPECT_FALSE(bridge->recorder->drives(later).back().command.zero());
  xdotool("keyup Up");
  EXPECT_TRUE(bridge->ended(later));
  xdotool("key g");
  EXPECT_TRUE(bridge->wait([&] { return !bridge->helm.arrowsAim(); }));
}

TEST_F(ConsoleDrive, theBarSaysWhatSlowsTheRobot) {
  xdotool("keydown w");
  EXPECT_TRUE(bridge->wait([&] {
    const std::string headline = bridge->window->driveBar()->words().headline;
    return headline.find(" m/s: front ranger sees something 0.") != std::string::npos;
  })) << bridge->window->driveBar()->words().headline;
  xdotool("keyup w");
}

// The last: afterwards the helm is gone.
TEST_F(ConsoleDrive, zLeavingSaysSo) {
  const double since = steadySeconds();
  bridge->helm.leave();
  EXPECT_TRUE(bridge->wait([&] {
    const auto beats = bridge->recorder->beats(since);
    return !beats.empty() && beats.back().message.leaving;
  }));
  QTest::qWait(200);  // what was sent before may still be on its way
  const auto count = bridge->recorder->beats(since).size();
  QTest::qWait(300);
  EXPECT_EQ(bridge->recorder->beats(since).size(), count);
  EXPECT_TRUE(bridge->recorder->beats(since).back().message.leaving);
  bridge->helm.start();  // for the silence that TearDown looks for
}

void onMessage(QtMsgType type, const QMessageLogContext&, const QString& message) {
  std::fprintf(stderr, "Qt: %s\n", qPrintable(message));
  if (type != QtDebugMsg && type != QtInfoMsg) ++qt_warnings;
}

int showOtherWindow(QApplication& application) {
  QWidget other;
  other.setWindowTitle("OtherWindow");
  other.resize(200, 100);
  other.show();
  return application.exec();
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: test_console_drive FAKE_ROBOT\n");
    return 2;
  }
  KeyWatcher::prepare();
  QApplication application(argc, argv);
  if (argv[1] == std::string("--other-window")) return showOtherWindow(application);
  robot_program = argv[1];
  own_program = argv[0];
  const QTemporaryDir home;
  const QString port = freePort();
  setenv("ROS_MASTER_URI", ("http://localhost:" + port.toStdString()).c_str(), 1);
  setenv("ROS_IP", "127.0.0.1", 1);
  for (const char* name : {"ROS_HOME", "ROS_LOG_DIR", "XDG_RUNTIME_DIR", "XDG_CONFIG_HOME"}) {
    setenv(name, qPrintable(home.path()), 1);
  }
  theme::apply(application);
  qInstallMessageHandler(onMessage);
  int result = 1;
  {
    Child windows("openbox", {"--sm-disable"});
    Child master("rosmaster", {"--core", "-p", port});
    Child robot(robot_program, {});
    if (windows.started() && master.started() && robot.started()) {
      result = RUN_ALL_TESTS();
    } else {
      std::fprintf(stderr, "openbox, rosmaster or fake_robot did not start\n");
    }
  }
  if (qt_warnings > 0) std::fprintf(stderr, "%d Qt warnings\n", qt_warnings);
  std::fflush(nullptr);
  std::_Exit(result != 0 || qt_warnings > 0 ? 1 : 0);  // a hanging ROS call must not keep us
}
