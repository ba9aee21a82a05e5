#pragma once

#include <QVector>
#include <QWidget>

#include "gui/model/task_words.hpp"
#include "gui/view/panel.hpp"

class QAction;
class QToolButton;

namespace pilothouse::gui {

/// What the robot is at: running, paused, why it waits or failed, how far and how long still; and
/// the keys that pause, skip and cancel.
class TaskBar : public QWidget {
  Q_OBJECT

 public:
  /// @param context with ask_place.
  explicit TaskBar(const PanelContext& context, QWidget* parent = nullptr);
  /// Words as they are now (steady [s]).
  void refresh(double now);
  const TaskWords& words() const { return words_; }
  /// A navigator was heard of.
  bool wanted() const { return wanted_; }
  QVector<QAction*> menuActions() const { return actions_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QToolButton* addCall(const QString& text, const QString& tip, const QKeySequence& key,
                       const std::function<void()>& call);
  void ask(TaskCall call);

  PanelContext context_;
  TaskWords words_;
  bool wanted_ = false;
  QVector<QAction*> actions_;
  QToolButton *pause_, *skip_, *cancel_;
};

/// What the words about the task are made from, as it is now.
TaskSituation taskSituationOf(const ConsoleState& state, double now);

}  // namespace pilothouse::gui
