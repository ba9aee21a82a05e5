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
  enum class State {
    kReady,
    kUnconfirmed,  ///< pressed, but no gate has said that it holds the robot
    kStopped,      ///< the gate says so
  };
  void show(State state);
  State state() const { return state_; }
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  State state_ = State::kReady;
};

/// Something risky that wants more than a click: it must be held until it is full. Only time that
/// the window was awake for counts, a hold that was dropped or done must be let go and begun anew.
class HoldButton : public QAbstractButton {
  Q_OBJECT

 public:
  static constexpr int kHold = 800;     ///< ms
  static constexpr int kDebounce = 30;  ///< ms; X lets a held key look released for a moment
  static constexpr int kLate = 100;     ///< ms; a longer pause between two looks counts nothing

  explicit HoldButton(QWidget* parent = nullptr);
  /// @param text of the button; @param key named below it.
  void show(const QString& text, const QString& key, bool possible);
  /// The key that holds it went down or up. @param repeated by the keyboard, not by a finger.
  void keyDown(bool repeated);
  void keyUp();
  /// Ends the hold. @param released what holds it may be let go without our hearing of it.
  void drop(bool released);
  QSize sizeHint() const override;

 signals:
  void begun();
  void confirmed();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void press();
  void letGo();
  void progress();

  QString key_;
  QTimer ticks_, release_;
  QElapsedTimer last_look_;
  int held_ = 0;          ///< ms
  bool down_ = false;     ///< the key or the mouse button
  bool holding_ = false;  ///< and it counts
};

}  // namespace pilothouse::gui
