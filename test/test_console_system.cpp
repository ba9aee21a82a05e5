// The whole console with a real master and a camera of its own process: what an operator sees while
// the master comes, goes and is replaced. Runs under test/with_display. Arguments: the program
// fake_camera.

#include <gtest/gtest.h>

#include <QApplication>
#include <QProcess>
#include <QRegularExpression>
#include <QTcpServer>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <cstdio>
#include <cstdlib>

#include "gui/model/clock.hpp"
#include "gui/model/ros_link.hpp"
#include "gui/view/main_window.hpp"
#include "gui/view/map_canvas.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/status_line.hpp"
#include "gui/view/theme.hpp"
#include "test/free_port.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

QString camera_program;
QString port;
int qt_warnings = 0;
constexpr int kPatience = 60000;  // ms; far above what anything here takes

/// A process that ends with the test, whatever happens.
class Child {
 public:
  Child(const QString& program, const QStringList& arguments) {
    process_.setProcessChannelMode(QProcess::ForwardedChannels);
    process_.start(program, arguments);
    started_ = process_.waitForStarted(kPatience);
  }
  ~Child() { end(); }
  bool started() const { return started_; }
  void end() {
    if (process_.state() == QProcess::NotRunning) return;
    process_.terminate();
    if (!process_.waitForFinished(5000)) process_.kill();
    process_.waitForFinished(5000);
  }

 private:
  QProcess process_;
  bool started_ = false;
};

struct Console {
  // Outlive everything: a ROS call may still use them while the test ends.
  ConsoleState& state = *new ConsoleState;
  RosLink& link = *new RosLink({"console"}, state);
  RobotDescription robot;
  std::unique_ptr<MainWindow> window;

  Console() {
    robot.name = "platform";
    robot.title = "Platform";
    robot.footprint = {{{0.25, 0.20}}, {{-0.25, 0.20}}, {{-0.25, -0.20}}, {{0.25, -0.20}}};
    window = std::make_unique<MainWindow>(PanelContext{state, robot, nullptr}, false);
    window->show();
    link.start();
  }
  ~Console() { EXPECT_TRUE(link.stop(10.0)); }

  /// @param text a regular expression.
  bool says(const QString& text) {
    const QRegularExpression pattern(text);
    return QTest::qWaitFor([&] { return window->statusLine()->sentence().contains(pattern); },
                           kPatience);
  }
  std::string sentence() const { return qPrintable(window->statusLine()->sentence()); }
};

TEST(Console, livesThroughAMastersComingsAndGoings) {
  const QStringList master_arguments = {"--core", "-p", port};
  Console console;
  ASSERT_TRUE(QTest::qWaitForWindowExposed(console.window.get()));
  ASSERT_TRUE(console.says("o master at http://localhost:" + port + ": waiting"))
      << console.sentence();

  auto master = std::make_unique<Child>("rosmaster", master_arguments);
  ASSERT_TRUE(master->started());
  ASSERT_TRUE(console.says("o depth: nobody publishes camera/depth/image_rect"))
      << console.sentence();

  auto camera = std::make_unique<Child>(camera_program, QStringList());
  ASSERT_TRUE(console.says("All streams arrive")) << console.sentence();
  EXPECT_TRUE(QTest::qWaitFor([&] { return console.window->complete(); }, kPatience));
  EXPECT_GT(console.state.depth.state(steadySeconds()).rate_hz, 1.0);
  auto* map = console.window->findChild<MapCanvas*>("map_canvas");
  const QImage shot = map->grab().toImage();
  EXPECT_EQ(
      QColor(shot.pixel((map->view().toPixel(-0.1, 0.1) * shot.devicePixelRatio()).toPoint())),
      robotColour());

  camera->end();
  ASSERT_TRUE(console.says("o depth for [0-9]+ s on camera/depth/image_rect"))
      << console.sentence();

  camera = std::make_unique<Child>(camera_program, QStringList("--lying-depth"));
  ASSERT_TRUE(console.says("epth rejected: ")) << console.sentence();
  EXPECT_GT(console.state.depth.state(steadySeconds()).rejected, 0U);
  camera->end();

  master->end();
  ASSERT_TRUE(console.says("ost the master at http://localhost:" + port)) << console.sentence();
  master = std::make_unique<Child>("rosmaster", master_arguments);
  camera = std::make_unique<Child>(camera_program, QStringList());
  ASSERT_TRUE(console.says("All streams arrive"))
      << "after the master was replaced: " << console.sentence();
}

// The window must stay alive while ROS hangs: a master that accepts and never answers.
TEST(Console, aMasterThatNeverAnswersDoesNotHoldTheWindow) {
  QTcpServer silent;
  ASSERT_TRUE(silent.listen(QHostAddress::LocalHost, static_cast<quint16>(port.toInt())));
  Console* console = new Console;  // its link thread hangs, so it is never joined
  ASSERT_TRUE(QTest::qWaitForWindowExposed(console->window.get()));
  int ticks = 0;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [&] { ++ticks; });
  timer.start(10);
  ASSERT_TRUE(QTest::qWaitFor([&] { return silent.hasPendingConnections(); }, kPatience));
  const int before = ticks;
  ASSERT_TRUE(QTest::qWaitFor([&] { return ticks > before + 50; }, kPatience));
  EXPECT_FALSE(console->link.stop(0.2))
      << "the link was expected to hang: this test proves nothing";
  console->window->close();
}

void onMessage(QtMsgType type, const QMessageLogContext&, const QString& message) {
  std::fprintf(stderr, "Qt: %s\n", qPrintable(message));
  if (type != QtDebugMsg && type != QtInfoMsg) ++qt_warnings;
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: test_console_system FAKE_CAMERA\n");
    return 2;
  }
  camera_program = argv[1];
  const QTemporaryDir home;
  port = freePort();
  setenv("ROS_MASTER_URI", ("http://localhost:" + port.toStdString()).c_str(), 1);
  setenv("ROS_IP", "127.0.0.1", 1);
  setenv("ROS_HOME", qPrintable(home.path()), 1);
  setenv("ROS_LOG_DIR", qPrintable(home.path()), 1);
  setenv("XDG_RUNTIME_DIR", qPrintable(home.path()), 1);
  QApplication application(argc, argv);
  theme::apply(application);
  qInstallMessageHandler(onMessage);
  const int result = RUN_ALL_TESTS();
  if (qt_warnings > 0) std::fprintf(stderr, "%d Qt warnings\n", qt_warnings);
  std::fflush(nullptr);
  std::_Exit(result != 0 || qt_warnings > 0 ? 1 : 0);  // a hanging ROS call must not keep us
}
