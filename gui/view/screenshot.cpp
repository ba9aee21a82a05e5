#include "gui/view/screenshot.hpp"

#include <QCoreApplication>
#include <QPixmap>
#include <QScreen>
#include <QTimer>
#include <QWindow>
#include <algorithm>
#include <cstdio>

#include "gui/view/main_window.hpp"

namespace pilothouse::gui {

namespace {

constexpr int kSettle = 2500;  // ms after completeness, so that rates and ages are measured

/// Of what draws past Qt (the 3D view) a window's own picture knows nothing: the screen's is taken.
QPixmap pictureOf(MainWindow& window) {
  const auto children = window.findChildren<QWidget*>();
  const bool beside = std::any_of(children.begin(), children.end(), [](const QWidget* child) {
    return child->isVisible() && child->testAttribute(Qt::WA_PaintOnScreen);
  });
  const QWindow* handle = window.windowHandle();
  if (!beside || !handle || !handle->screen()) return window.grab();
  return handle->screen()->grabWindow(window.winId());
}

void write(MainWindow& window, const QString& file) {
  window.refreshNow();
  const bool written = pictureOf(window).save(file, "PNG");
  if (!written) std::fprintf(stderr, "console: cannot write %s\n", qPrintable(file));
  QCoreApplication::exit(written ? 0 : 1);
}

}  // namespace

void takeScreenshot(MainWindow& window, const QString& file, double after_s) {
  if (after_s >= 0.0) {
    QTimer::singleShot(static_cast<int>(after_s * 1000.0), &window,
                       [&window, file] { write(window, file); });
    return;
  }
  auto* watch = new QTimer(&window);
  QObject::connect(watch, &QTimer::timeout, &window, [&window, watch, file] {
    if (!window.complete()) return;
    watch->stop();
    QTimer::singleShot(kSettle, &window, [&window, file] { write(window, file); });
  });
  watch->start(50);
}

}  // namespace pilothouse::gui
