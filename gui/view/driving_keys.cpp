#include "gui/view/driving_keys.hpp"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTextEdit>
#include <QWindow>
#include <optional>

#include "gui/model/helm.hpp"

namespace pilothouse::gui {

namespace {

std::optional<KeyMeaning> meaningOf(int key) {
  switch (key) {
    case Qt::Key_W:
      return KeyMeaning{DriveKey::kForward, 0};
    case Qt::Key_Up:
      return KeyMeaning{DriveKey::kForward, 1};
    case Qt::Key_S:
      return KeyMeaning{DriveKey::kBack, 0};
    case Qt::Key_Down:
      return KeyMeaning{DriveKey::kBack, 1};
    case Qt::Key_A:
      return KeyMeaning{DriveKey::kTurnLeft, 0};
    case Qt::Key_Left:
      return KeyMeaning{DriveKey::kTurnLeft, 1};
    case Qt::Key_D:
      return KeyMeaning{DriveKey::kTurnRight, 0};
    case Qt::Key_Right:
      return KeyMeaning{DriveKey::kTurnRight, 1};
    case Qt::Key_Q:
      return KeyMeaning{DriveKey::kSideLeft, 0};
    case Qt::Key_E:
      return KeyMeaning{DriveKey::kSideRight, 0};
    case Qt::Key_Shift:
      return KeyMeaning{DriveKey::kSlow, 0};
    default:
      return std::nullopt;
  }
}

bool types(const QWidget* widget) {
  return qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QLineEdit*>(widget) ||
         qobject_cast<const QTextEdit*>(widget) || qobject_cast<const QPlainTextEdit*>(widget) ||
         qobject_cast<const QComboBox*>(widget);
}

bool keysDrive() {
  return !qobject_cast<QDialog*>(QApplication::activeWindow()) &&
         !QApplication::activePopupWidget() && !types(QApplication::focusWidget());
}

}  // namespace

DrivingKeys::DrivingKeys(Helm& helm, bool watched, QObject* parent)
    : QObject(parent), helm_(helm), watched_(watched) {
  qApp->installEventFilter(this);
  connect(qApp, &QGuiApplication::focusWindowChanged, this, &DrivingKeys::review);
  connect(qobject_cast<QApplication*>(qApp), &QApplication::focusChanged, this,
          &DrivingKeys::review);
  connect(qApp, &QGuiApplication::applicationStateChanged, this, &DrivingKeys::review);
  review();
}

void DrivingKeys::review() {
  const QWindow* window = QGuiApplication::focusWindow();
  helm_.setActive(window && !(window->windowStates() & Qt::WindowMinimized));
  helm_.setKeysDrive(keysDrive());
  helm_.windowLives();
}

bool DrivingKeys::key(QKeyEvent& event, bool pressed) {
  if (event.key() == Qt::Key_Space || event.key() == Qt::Key_Escape) {
    if (pressed) helm_.stop();
    if (pressed && event.key() == Qt::Key_Escape && keysDrive()) emit aimed(event.key(), {});
    // Escape goes on to close what it usually closes.
    return event.key() == Qt::Key_Space;
  }
  const auto meaning = meaningOf(event.key());
  if (!meaning) return false;
  if (!pressed) {
    // A release is never wrong, wherever the focus is by now.
    if (!watched_ && !event.isAutoRepeat()) helm_.letGo(*meaning);
    return false;
  }
  if (!keysDrive() ||
      (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)))
    return false;
  const bool aims = meaning->variant == 1 && helm_.arrowsAim();
  if (!watched_ && !event.isAutoRepeat()) helm_.press(*meaning);
  if (aims) emit aimed(event.key(), event.modifiers());
  return true;
}

// X may deliver what the keyboard repeats as a release and a press of the same moment, unmarked.
bool DrivingKeys::repeats(const QKeyEvent& event) {
  constexpr unsigned long kDebounce = 15;  // ms
  return event.timestamp() != 0 && event.key() == released_ &&
         event.timestamp() - released_at_ < kDebounce;
}

// A key that is not kept comes twice, to the window and to the widget: both mean the same.
bool DrivingKeys::eventFilter(QObject*, QEvent* event) {
  switch (event->type()) {
    case QEvent::ShortcutOverride: {
      auto& press = *static_cast<QKeyEvent*>(event);
      if (!repeats(press)) return false;
      press.accept();  // no shortcut: what it does was done at the first press
      return true;
    }
    case QEvent::KeyPress:
      return key(*static_cast<QKeyEvent*>(event), true);
    case QEvent::KeyRelease:
      released_ = static_cast<QKeyEvent*>(event)->key();
      released_at_ = static_cast<QKeyEvent*>(event)->timestamp();
      return key(*static_cast<QKeyEvent*>(event), false);
    case QEvent::WindowDeactivate:
      review();
      return false;
    default:
      return false;
  }
}

}  // namespace pilothouse::gui
