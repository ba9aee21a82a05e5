#pragma once

#include <QMainWindow>
#include <QVector>

#include "gui/view/panel_registry.hpp"

class QDockWidget;
class QMenuBar;
class QToolBar;
class QTimer;

namespace pilothouse::gui {

class DriveBar;
class TaskBar;
class DrivingKeys;
class StatusLine;

/// The console's window: panels in docks, menus, status line, and the clock that refreshes them.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// @param remember whether the layout is read from and saved to the user's settings.
  /// @param keys_watched a KeyWatcher reads the driving keys.
  MainWindow(const PanelContext& context, bool remember, bool keys_watched = false);

  /// Every shown panel has fresh data.
  bool complete() const;
  StatusLine* statusLine() const { return status_; }
  /// Null without a helm.
  DriveBar* driveBar() const { return bar_; }
  TaskBar* taskBar() const { return task_bar_; }
  /// One round of what the timers do (tests and screenshots).
  void refreshNow();

 public slots:
  void resetLayout();

 signals:
  void closed();

 protected:
  void showEvent(QShowEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  struct Shown {
    PanelEntry entry;
    Panel* panel;
    QDockWidget* dock;
  };
  void addPanel(const PanelEntry& entry);
  void addDriveBar(bool keys_watched);
  void addTaskBar();
  void buildMenus();
  void shareOut();
  void refreshPictures();
  void refreshNumbers();

  PanelContext context_;
  bool remember_, restored_ = false;
  QVector<Shown> panels_;
  StatusLine* status_;
  QMenuBar* menus_;
  DriveBar* bar_ = nullptr;
  TaskBar* task_bar_ = nullptr;
  QToolBar* task_row_ = nullptr;
  DrivingKeys* keys_ = nullptr;
  QTimer* pictures_;
  QTimer* numbers_;
};

}  // namespace pilothouse::gui
