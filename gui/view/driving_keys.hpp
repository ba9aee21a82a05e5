#pragma once

#include <QObject>

class QKeyEvent;

namespace pilothouse::gui {

class Helm;

/// Sees every key before any widget does: the stop key works whatever has the focus, driving keys
/// drive unless somebody types. Where a KeyWatcher reads the keyboard as well, driving keys are
/// only kept from the widgets here. Tells the helm who has the focus.
class DrivingKeys : public QObject {
  Q_OBJECT

 public:
  /// @param watched a KeyWatcher runs.
  DrivingKeys(Helm& helm, bool watched, QObject* parent = nullptr);
  /// Focus, dialogs and fields as they are now; also a sign of life of the GUI thread.
  void review();

 signals:
  /// An arrow key pressed to aim, or Escape, which stops and takes back.
  void aimed(int key, Qt::KeyboardModifiers modifiers);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  bool key(QKeyEvent& event, bool pressed);
  bool repeats(const QKeyEvent& event);

  Helm& helm_;
  bool watched_;
  int released_ = 0;  ///< the key that was let go last, by the server's clock [ms]
  unsigned long released_at_ = 0;
};

}  // namespace pilothouse::gui
