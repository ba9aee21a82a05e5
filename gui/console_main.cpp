// The operator's console: parses the command line, starts the ROS link and shows the window.

#include <QApplication>
#include <QCoreApplication>
#include <QTimer>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "gui/model/helm.hpp"
#include "gui/model/key_watcher.hpp"
#include "gui/model/ros_link.hpp"
#include "gui/view/drive_bar.hpp"
#include "gui/view/main_window.hpp"
#include "gui/view/options.hpp"
#include "gui/view/screenshot.hpp"
#include "gui/view/theme.hpp"

namespace {

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) {
  interrupted = 1;
}

int refuse(const std::string& reason) {
  std::fprintf(stderr, "console: %s\n", reason.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace pilothouse::gui;
  const std::vector<std::string> arguments(argv, argv + argc);
  QStringList words;
  for (int i = 1; i < argc; ++i) words << QString::fromLocal8Bit(argv[i]);
  if (words.contains("--help") || words.contains("-h")) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  KeyWatcher::prepare();
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QCoreApplication::setOrganizationName("pilothouse");
  QCoreApplication::setApplicationName("console");
  QApplication application(argc, argv);

  const auto options = parseOptions(words);
  if (!options) return refuse(options.reason());
  const auto robot = pilothouse::readRobotFile(options->robot_file);
  if (!robot) return refuse(robot.reason());

  theme::apply(application);
  // Leaked on purpose: a ROS call that never returns may still hold them when the process ends.
  auto& state = *new ConsoleState;
  auto& helm = *new Helm(robot->drive);
  auto& link = *new RosLink(arguments, state, &helm);
  const PanelContext context{
      state,
      *robot,
      [&link](const std::string& method, bool calibrate) { link.askFloor(method, calibrate); },
      &helm,
      [&link](StopSerial stops) { link.askArm(stops); },
      [&link](const std::function<void(PlaceAsks&)>& ask) { link.askPlace(ask); }};
  const bool pictured = !options->screenshot.isEmpty();
  const bool watches_keys = QGuiApplication::platformName() == "xcb";
  std::unique_ptr<KeyWatcher> watcher;
  if (watches_keys) watcher = KeyWatcher::open(helm);
  auto window_owner = std::make_unique<MainWindow>(context, !pictured, watcher != nullptr);
  MainWindow& window = *window_owner;
  window.show();
  if (watcher) watcher->heed(window.winId());
  helm.start();
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  link.start();
  if (pictured) takeScreenshot(window, options->screenshot, options->after_s);

  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, [&] {
    if (interrupted || link.killed()) window.close();
    if (!watcher || !window.driveBar()) return;
    const QRect stop = window.driveBar()->stopPlace();
    watcher->heedPresses({stop.x(), stop.y(), stop.width(), stop.height()});
  });
  watch.start(100);

  const int result = application.exec();
  helm.leave();
  watcher.reset();
  window.hide();
  watch.stop();
  window_owner.reset();  // before ROS goes: the 3D panel uses it
  if (!link.stop(1.0)) {
    // A call into ROS hangs, e.g. on a master that accepts but never answers. Settings are saved.
    std::fflush(nullptr);
    std::_Exit(result);
  }
  return result;
}
