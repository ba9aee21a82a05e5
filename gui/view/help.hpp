#pragma once

#include <QMainWindow>

namespace pilothouse::gui {

/// A sheet of all keys, gathered from the window's own actions.
void showShortcuts(QMainWindow& window);
void showAbout(QMainWindow& window);

}  // namespace pilothouse::gui
