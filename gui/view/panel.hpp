#pragma once

#include <QVector>
#include <QWidget>
#include <functional>

#include "doors/robot_description.hpp"
#include "gui/model/console_state.hpp"
#include "gui/model/helm.hpp"

class QAction;

namespace pilothouse::gui {

class PlaceAsks;

/// What a panel may use. All of it outlives the panels.
struct PanelContext {
  ConsoleState& state;
  const RobotDescription& robot;
  /// Asks the floor nodelet for (method, calibrate mounting); null in tests.
  std::function<void(const std::string&, bool)> ask_floor;
  Helm* helm = nullptr;  ///< null: a window that only watches
  /// Takes back the stops up to this one and asks the stop gate to let the robot drive again.
  std::function<void(StopSerial)> ask_arm = nullptr;
  /// Runs an ask about the place at the robot's side; null: a window that only watches.
  std::function<void(const std::function<void(PlaceAsks&)>&)> ask_place = nullptr;
};

/// A key that is held down says a thing once. Only where that is harmless, as for what moves a view
/// or turns a ghost, it may say it again and again: marks such an action.
void repeatWhileHeld(QAction* action);

/// One dock of the console. Each panel is one class in one file of view/panels that registers
/// itself (panel_registry.hpp).
class Panel : public QWidget {
  Q_OBJECT

 public:
  explicit Panel(PanelContext context, QWidget* parent = nullptr)
      : QWidget(parent), context_(context) {}

  /// Takes the newest picture if there is one that is due; called 80 times a second. @param now
  /// steady time [s].
  virtual void refreshPicture(double now) = 0;
  /// Brings words and figures up to date; called 5 times a second.
  virtual void refreshNumbers(double now) = 0;
  /// Shows fresh data: a screenshot with --when-complete waits for every panel.
  virtual bool complete() const = 0;
  /// An arrow key that aims, or Escape, which has stopped the robot and takes back what is not
  /// sent.
  virtual void aimed(int /*key*/, Qt::KeyboardModifiers /*modifiers*/) {}
  /// Shown in the dock's title bar; owned by the panel's caller once taken. Null: a plain title.
  virtual QWidget* titleStrip() { return nullptr; }
  /// Entries of a menu of its own, with their keys; none: no menu.
  virtual QVector<QAction*> menuActions() { return {}; }

 signals:
  /// What was asked for happens here: the panel must be seen.
  void wanted();

 protected:
  const PanelContext& context() const { return context_; }

 private:
  PanelContext context_;
};

}  // namespace pilothouse::gui
