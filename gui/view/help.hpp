#pragma once

#include <QMainWindow>

class QMenuBar;

namespace pilothouse::gui {

/// A sheet of all keys, gathered from its menus.
void showShortcuts(QMainWindow& window, const QMenuBar& menus);
void showAbout(QMainWindow& window);

}  // namespace pilothouse::gui
