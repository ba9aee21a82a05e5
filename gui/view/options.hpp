#pragma once

#include <QStringList>
#include <string>

#include "core/cloud/checked.hpp"

namespace pilothouse::gui {

/// What the command line asks for.
struct Options {
  bool help = false;
  std::string robot_file;
  QString screenshot;     ///< empty: none
  double after_s = -1.0;  ///< seconds until the screenshot; < 0: when complete
};

extern const char* const kUsage;

/// Understands the arguments (without the program's name). ROS remappings (name:=value) are left to
/// ROS. Refuses with one line.
Checked<Options> parseOptions(const QStringList& arguments);

}  // namespace pilothouse::gui
