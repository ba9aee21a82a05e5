#pragma once

#include <QWidget>

#include "gui/model/drive_words.hpp"

namespace pilothouse::gui {

/// The sentence about driving with its advice below.
class SpokenCause : public QWidget {
  Q_OBJECT

 public:
  explicit SpokenCause(QWidget* parent = nullptr);
  void show(const DriveWords& words);
  QSize sizeHint() const override { return {420, 48}; }
  QSize minimumSizeHint() const override { return {140, 40}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  DriveWords words_;
};

/// The driving keys as they lie on the keyboard, lit while they drive, and the speed they ask for.
class KeyLights : public QWidget {
  Q_OBJECT

 public:
  /// @param sideways the base can drive sideways.
  explicit KeyLights(bool sideways, QWidget* parent = nullptr);
  void show(const HelmView& view);
  QSize sizeHint() const override { return {138, 48}; }
  QSize minimumSizeHint() const override { return {80, 48}; }  // where the bar is short: the keys

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  bool sideways_;
  HelmView view_;
};

}  // namespace pilothouse::gui
