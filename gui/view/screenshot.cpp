#include "gui/view/screenshot.hpp"

#include <QCoreApplication>
#include <QPixmap>
#include <QTimer>
#include <cstdio>

#include "gui/view/main_window.hpp"

namespace pilothouse::gui {

namespace {

constexpr int kSettle = 2500;  // ms after completeness, so that rates and ages are measured

void write(MainWindow& window, const QString& file) {
  window.refreshNow();
  const bool written = window.grab().save(file, "PNG");
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
