#include "gui/view/main_window.hpp"

#include <QAction>
#include <QCloseEvent>
#include <QDockWidget>
#include <QGuiApplication>
#include <QMenuBar>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>
#include <QVBoxLayout>

#include "gui/model/clock.hpp"
#include "gui/view/header_strip.hpp"
#include "gui/view/help.hpp"
#include "gui/view/status_line.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {
constexpr int kPictureInterval = 12;  // ms between looks for new pictures; Pace bounds the drawing
constexpr int kNumberInterval = 200;  // ms
constexpr int kLayoutVersion = 1;     // raise when ids or places of panels change
}  // namespace

MainWindow::MainWindow(const PanelContext& context, bool remember)
    : context_(context),
      remember_(remember),
      status_(new StatusLine),
      pictures_(new QTimer(this)),
      numbers_(new QTimer(this)) {
  setWindowTitle(tr("Pilothouse - %1").arg(QString::fromStdString(context.robot.title)));
  setDockOptions(AllowNestedDocks | AllowTabbedDocks | AnimatedDocks);
  // A screenshot has the same size on every screen; the operator's window must fit theirs.
  const QSize usual(1280, 720);
  resize(remember ? usual.boundedTo(QGuiApplication::primaryScreen()->availableSize()) : usual);
  for (const auto& entry : panelRegistry()) addPanel(entry);
  auto* bar = new QStatusBar;
  bar->setSizeGripEnabled(false);
  bar->setContentsMargins(0, 0, 0, 0);
  bar->addPermanentWidget(status_, 1);
  setStatusBar(bar);
  buildMenus();
  resetLayout();
  if (remember_) {
    QSettings settings;
    restoreGeometry(settings.value("window/geometry").toByteArray());
    restoreState(settings.value("window/docks").toByteArray(), kLayoutVersion);
  }
  pictures_->setTimerType(Qt::PreciseTimer);
  connect(pictures_, &QTimer::timeout, this, &MainWindow::refreshPictures);
  connect(numbers_, &QTimer::timeout, this, &MainWindow::refreshNumbers);
  pictures_->start(kPictureInterval);
  numbers_->start(kNumberInterval);
  refreshNow();
}

void MainWindow::addPanel(const PanelEntry& entry) {
  if (entry.hindrance && !entry.hindrance().isEmpty()) {
    panels_.push_back({entry, nullptr, nullptr});
    return;
  }
  auto* dock = new QDockWidget(entry.title, this);
  dock->setObjectName(QString::fromStdString(entry.id));
  auto* panel = entry.make(context_);
  panel->setObjectName(dock->objectName() + "_panel");
  dock->setWidget(panel);
  if (auto* strip = qobject_cast<HeaderStrip*>(panel->titleStrip())) {
    dock->setTitleBarWidget(strip);
    connect(strip, &HeaderStrip::closeWanted, dock, &QDockWidget::close);
    connect(strip, &HeaderStrip::floatWanted, dock,
            [dock] { dock->setFloating(!dock->isFloating()); });
  }
  panels_.push_back({entry, panel, dock});
}

void MainWindow::resetLayout() {
  QDockWidget* main = nullptr;
  QDockWidget* side = nullptr;
  QList<QDockWidget*> columns, rows;
  QList<int> widths, heights;
  for (const auto& shown : panels_) {
    if (!shown.dock) continue;
    QDockWidget*& last = shown.entry.place == PanelPlace::kMain ? main : side;
    shown.dock->setFloating(false);
    if (!last) {
      addDockWidget(
          shown.entry.place == PanelPlace::kMain ? Qt::LeftDockWidgetArea : Qt::RightDockWidgetArea,
          shown.dock);
      columns << shown.dock;
      // 454 of 1280: room for a 4:3 picture with its legend in half the height.
      const int side_width = width() * 454 / 1280;
      widths << (shown.entry.place == PanelPlace::kMain ? width() - side_width : side_width);
    } else if (shown.entry.place == PanelPlace::kMain) {
      tabifyDockWidget(last, shown.dock);
    } else {
      splitDockWidget(last, shown.dock, Qt::Vertical);
    }
    if (shown.entry.place == PanelPlace::kSide && shown.entry.shown) {
      rows << shown.dock;
      heights << height() / 2;
    }
    last = shown.dock;
    shown.dock->setVisible(shown.entry.shown);
  }
  resizeDocks(columns, widths, Qt::Horizontal);
  resizeDocks(rows, heights, Qt::Vertical);
}

void MainWindow::buildMenus() {
  auto* console = menuBar()->addMenu(tr("&Console"));
  auto* quit = console->addAction(tr("&Quit"), this, &QWidget::close);
  quit->setShortcut(QKeySequence("Ctrl+Q"));

  auto* view = menuBar()->addMenu(tr("&View"));
  int number = 0;  // a panel that cannot be had keeps its number: keys never move
  for (const auto& shown : panels_) {
    ++number;
    if (!shown.dock) {
      auto* missing =
          view->addAction(tr("%1 (%2)").arg(shown.entry.title, shown.entry.hindrance()));
      missing->setEnabled(false);
      continue;
    }
    auto* toggle = shown.dock->toggleViewAction();
    toggle->setShortcut(QKeySequence(QString("Ctrl+%1").arg(number)));
    connect(toggle, &QAction::triggered, shown.dock, [dock = shown.dock](bool on) {
      if (on) dock->raise();  // in front of those that share its place
    });
    view->addAction(toggle);
  }
  view->addSeparator();
  auto* whole = view->addAction(tr("Full screen"), this,
                                [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
  whole->setShortcut(QKeySequence("F11"));
  auto* reset = view->addAction(tr("Reset the layout"), this, &MainWindow::resetLayout);
  reset->setShortcut(QKeySequence("Ctrl+0"));

  for (const auto& shown : panels_) {
    const auto actions = shown.panel ? shown.panel->menuActions() : QVector<QAction*>();
    if (actions.isEmpty()) continue;
    auto* own = menuBar()->addMenu(shown.entry.title);
    for (auto* action : actions) own->addAction(action);
  }

  auto* help = menuBar()->addMenu(tr("&Help"));
  auto* keys = help->addAction(tr("Keyboard shortcuts"), this, [this] { showShortcuts(*this); });
  keys->setShortcut(QKeySequence("F1"));
  help->addAction(tr("About Pilothouse"), this, [this] { showAbout(*this); });
}

bool MainWindow::complete() const {
  for (const auto& shown : panels_) {
    if (shown.dock && shown.dock->isVisible() && !shown.panel->complete()) return false;
  }
  return true;
}

void MainWindow::refreshPictures() {
  const double now = steadySeconds();
  for (const auto& shown : panels_) {
    if (shown.panel) shown.panel->refreshPicture(now);
  }
}

void MainWindow::refreshNumbers() {
  const double now = steadySeconds();
  for (const auto& shown : panels_) {
    if (shown.panel) shown.panel->refreshNumbers(now);
  }
  status_->show(situationOf(context_.state, context_.robot.name, now));
}

void MainWindow::refreshNow() {
  refreshPictures();
  refreshNumbers();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (remember_) {
    QSettings settings;
    settings.setValue("window/geometry", saveGeometry());
    settings.setValue("window/docks", saveState(kLayoutVersion));
  }
  event->accept();
  emit closed();
}

}  // namespace pilothouse::gui
