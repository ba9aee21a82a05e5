#pragma once

#include <QWidget>

#include "gui/model/feed_meter.hpp"

class QPainter;
class QToolButton;

namespace pilothouse::gui {

/// Title of a picture with its rate, age and drops: the dock's title bar. Painted, so that changing
/// figures never move anything.
class HeaderStrip : public QWidget {
  Q_OBJECT

 public:
  explicit HeaderStrip(const QString& title, QWidget* parent = nullptr);
  void show(const FeedState& state);
  /// For a panel that is not one stream of pictures.
  void withoutFigures() { has_figures_ = false; }
  /// Places a control after the title; the strip owns it.
  void addControl(QWidget* control);
  /// What the control holds is another: its size too. @param needed it matters more than the
  /// figures where the strip is short.
  void controlChanged(bool needed);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;
  /// The figures in words, e.g. "5.0 Hz  age 0.1 s  0 dropped" (also for tests and tool tips).
  QString figures() const;

 signals:
  void closeWanted();
  void floatWanted();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QString title_;
  FeedState state_;
  bool has_figures_ = true;
  QToolButton* close_;
  QToolButton* float_;
  QWidget* control_ = nullptr;
  bool control_needed_ = false;
  void placeControl();
  void paintFigures(QPainter& painter, int title_end) const;
};

}  // namespace pilothouse::gui
