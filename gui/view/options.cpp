#include "gui/view/options.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>

namespace pilothouse::gui {

const char* const kUsage =
    R"(usage: console [--robot NAME|FILE] [--screenshot FILE [--after SECONDS | --when-complete]] [NAME:=VALUE ...]

The operator's console. It may be started before the ROS master: it connects when one appears.

  --robot NAME|FILE   the robot to draw: a name in config/robots or a YAML file (default: platform)
  --screenshot FILE   write the window as PNG to FILE, then exit
  --after SECONDS     take the screenshot after this time
  --when-complete     take it when every panel shows data (the default with --screenshot)
  --help              print this
  NAME:=VALUE         ROS remapping, e.g. camera/depth/image_rect:=/cam/depth/image_raw

ROS_MASTER_URI names the master (default http://localhost:11311).
)";

namespace {

using Result = Checked<Options>;

Result refuse(const QString& reason) {
  return Result::refused(reason.toStdString());
}

// The file of a robot: as given, or by its name in the installed or the source configuration.
QString robotFile(const QString& robot) {
  if (robot.contains('/') || robot.endsWith(".yaml"))
    return QFileInfo(robot).isFile() ? robot : QString();
  const QString below = "/robots/" + robot + ".yaml";
  const QString installed = QDir(QCoreApplication::applicationDirPath())
                                .filePath("../../share/pilothouse/config" + below);
  for (const QString& file : {installed, QStringLiteral(PILOTHOUSE_CONFIG_DIR) + below}) {
    if (QFileInfo(file).isFile()) return QDir::cleanPath(file);
  }
  return {};
}

}  // namespace

Result parseOptions(const QStringList& arguments) {
  Options options;
  QString robot = "platform";
  bool timed = false;
  for (int i = 0; i < arguments.size(); ++i) {
    const QString& argument = arguments[i];
    const auto value = [&]() -> QString {
      return i + 1 < arguments.size() ? arguments[++i] : QString();
    };
    if (argument == "--help" || argument == "-h") {
      options.help = true;
      return Result::of(options);
    }
    if (argument == "--robot") {
      robot = value();
      if (robot.isEmpty()) return refuse("--robot needs a name or a file");
    } else if (argument == "--screenshot") {
      options.screenshot = value();
      if (options.screenshot.isEmpty()) return refuse("--screenshot needs a file");
    } else if (argument == "--after") {
      bool number = false;
      const QString text = value();
      options.after_s = text.toDouble(&number);
      if (!number || !(options.after_s >= 0.0 && options.after_s <= 86400.0)) {
        return refuse("--after '" + text + "': expected seconds from 0 to 86400");
      }
      timed = true;
    } else if (argument == "--when-complete") {
      options.after_s = -1.0;
      timed = true;
    } else if (!argument.contains(":=")) {
      return refuse("unknown option '" + argument + "' (--help lists them)");
    }
  }
  if (timed && options.screenshot.isEmpty())
    return refuse("--after and --when-complete need --screenshot FILE");
  const QFileInfo folder(QFileInfo(options.screenshot).absolutePath());
  if (!options.screenshot.isEmpty() && !(folder.isDir() && folder.isWritable())) {
    return refuse("--screenshot: cannot write into " + folder.filePath());
  }
  const QString file = robotFile(robot);
  if (file.isEmpty()) return refuse("--robot '" + robot + "': no such robot or file");
  options.robot_file = file.toStdString();
  return Result::of(options);
}

}  // namespace pilothouse::gui
