#pragma once

#include <QAbstractButton>
#include <QElapsedTimer>
#include <QTimer>

namespace pilothouse::gui {

/// The stop: acts on the press, not on the release, and again each time.
class StopButton : public QAbstractButton {
  Q_OBJECT

 public:
  explicit StopButton(QWidget* parent = nullptr);
  /// @param latched the robot is held by a stop.
  void show(bool latched);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  bool latched_ = false;
};

/// Something risky that wants more than a click: it must be held until it is full.
class HoldButton : public QAbstractButton {
  Q_OBJECT

 public:
  static constexpr int kHold = 800;     ///< ms
  static constexpr int kDebounce = 30;  ///< ms; X lets a held key look released for a moment

  explicit HoldButton(QWidget* parent = nullptr);
  /// @param text of the button; @param key named below it.
  void show(const QString& text, const QString& key, bool possible);
  /// The key that holds it went down or up.
  void keyDown();
  void keyUp();
  QSize sizeHint() const override;

 signals:
  void confirmed();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void begin();
  void end();
  void progress();

  QString key_;
  QTimer ticks_, release_;
  QElapsedTimer since_;
  bool holding_ = false;
};

}  // namespace pilothouse::gui
