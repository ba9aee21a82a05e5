#include "gui/view/sheet.hpp"

#include <QDialog>
#include <QMainWindow>
#include <algorithm>

namespace pilothouse::gui {

namespace {

// Below the bar with the stop.
QRect placeOf(const QWidget& over) {
  const QWidget& window = *over.window();
  QRect place(window.mapToGlobal(QPoint(0, 0)), window.size());
  const auto* main = qobject_cast<const QMainWindow*>(&window);
  const QWidget* top = main ? main->menuWidget() : nullptr;
  if (top) place.setTop(place.top() + top->geometry().bottom() + 1);
  return place;
}

}  // namespace

void showBeside(QDialog& dialog, const QWidget& over) {
  for (auto* other : over.window()->findChildren<QDialog*>()) {
    if (other != &dialog) other->close();
  }
  dialog.setModal(false);
  dialog.adjustSize();
  const QRect place = placeOf(over);
  const QPoint corner = place.center() - dialog.rect().center();
  dialog.move(std::max(place.left(), corner.x()), std::max(place.top(), corner.y()));
  dialog.show();
}

QSize roomBeside(const QWidget& over) {
  return placeOf(over).size();
}

}  // namespace pilothouse::gui
