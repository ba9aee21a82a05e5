#pragma once

#include <QString>

namespace pilothouse::gui {

class MainWindow;

/// Writes the window as PNG and ends the application: after a time, or (after_s < 0) as soon as the
/// window is complete. Exit code 1 when the file cannot be written.
void takeScreenshot(MainWindow& window, const QString& file, double after_s);

}  // namespace pilothouse::gui
