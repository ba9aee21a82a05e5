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
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/model/clock.hpp"
#include "gui/view/drive_bar.hpp"
#include "gui/view/driving_keys.hpp"
#include "gui/view/header_strip.hpp"
#include "gui/view/help.hpp"
#include "gui/view/status_line.hpp"
#include "gui/view/task_bar.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {
constexpr int kPictureInterval = 12;  // ms between looks for new pictures; Pace bounds the drawing
constexpr int kNumberInterval = 200;  // ms
constexpr const char* kRepeats = "repeats";
constexpr int kLayoutVersion = 2;  // raise when ids or places of panels change
}  // namespace

MainWindow::MainWindow(const PanelContext& context, bool remember, bool keys_watched)
    : context_(context),
      remember_(remember),
      status_(new StatusLine),
      menus_(new QMenuBar),
      pictures_(new QTimer(this)),
      numbers_(new QTimer(this)) {
  setWindowTitle(tr("Pilothouse - %1").arg(QString::fromStdString(context.robot.title)));
  setDockOptions(AllowNestedDocks | AllowTabbedDocks | AnimatedDocks);
  // A screenshot has the same size on every screen; the operator's window must fit theirs.
  const QSize usual(1280, 800);
  resize(remember ? usual.boundedTo(QGuiApplication::primaryScreen()->availableSize()) : usual);
  if (context.helm) {
    addDriveBar(keys_watched);
  } else {
    setMenuBar(menus_);
  }
  if (context.ask_place) addTaskBar();
  for (const auto& entry : panelRegistry()) addPanel(entry);
  auto* bar = new QStatusBar;
  bar->setSizeGripEnabled(false);
  bar->setContentsMargins(0, 0, 0, 0);
  bar->addPermanentWidget(status_, 1);
  setStatusBar(bar);
  buildMenus();
  if (keys_) {
    connect(keys_, &DrivingKeys::aimed, this, [this](int key, Qt::KeyboardModifiers modifiers) {
      for (const auto& shown : panels_) {
        if (shown.panel) shown.panel->aimed(key, modifiers);
      }
    });
  }
  resetLayout();
  if (remember_) restoreGeometry(QSettings().value("window/geometry").toByteArray());
  pictures_->setTimerType(Qt::PreciseTimer);
  connect(pictures_, &QTimer::timeout, this, &MainWindow::refreshPictures);
  connect(numbers_, &QTimer::timeout, this, &MainWindow::refreshNumbers);
  pictures_->start(kPictureInterval);
  numbers_->start(kNumberInterval);
  refreshNow();
}

void MainWindow::addDriveBar(bool keys_watched) {
  bar_ = new DriveBar(context_);
  keys_ = new DrivingKeys(*context_.helm, keys_watched, this);
  // Above the menus: the stop is always in sight, and none of them opens over it.
  auto* top = new QWidget;
  auto* rows = new QVBoxLayout(top);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  rows->addWidget(bar_);
  rows->addWidget(menus_);
  setMenuWidget(top);
}

// Only where a navigator is heard of: a camera alone has no tasks.
void MainWindow::addTaskBar() {
  task_bar_ = new TaskBar(context_);
  task_row_ = new QToolBar(tr("Task"));
  task_row_->setObjectName("task_bar");
  task_row_->setMovable(false);
  task_row_->setFloatable(false);
  task_row_->addWidget(task_bar_);
  task_row_->toggleViewAction()->setVisible(false);
  task_row_->setContextMenuPolicy(Qt::PreventContextMenu);
  addToolBarBreak(Qt::TopToolBarArea);
  addToolBar(Qt::TopToolBarArea, task_row_);
  task_row_->setVisible(false);
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
  connect(panel, &Panel::wanted, dock, [dock] {
    dock->show();
    dock->raise();
  });
  if (auto* strip = qobject_cast<HeaderStrip*>(panel->titleStrip())) {
    dock->setTitleBarWidget(strip);
    connect(strip, &HeaderStrip::closeWanted, dock, &QDockWidget::close);
    connect(strip, &HeaderStrip::floatWanted, dock,
            [dock] { dock->setFloating(!dock->isFloating()); });
  }
  panels_.push_back({entry, panel, dock});
}

// The map at the left; at the right a row of pictures, and the graphs below it.
void MainWindow::resetLayout() {
  QDockWidget* last[3] = {};
  QDockWidget* first[3] = {};
  const auto room = [](PanelPlace place) { return static_cast<std::size_t>(place); };
  for (const auto& shown : panels_) {
    if (!shown.dock) continue;
    shown.dock->setFloating(false);
    QDockWidget*& before = last[room(shown.entry.place)];
    if (!before) {
      first[room(shown.entry.place)] = shown.dock;
      if (shown.entry.place == PanelPlace::kMain) {
        addDockWidget(Qt::LeftDockWidgetArea, shown.dock);
      } else if (shown.entry.place == PanelPlace::kGraph && last[room(PanelPlace::kPicture)]) {
        splitDockWidget(first[room(PanelPlace::kPicture)], shown.dock, Qt::Vertical);
      } else {
        addDockWidget(Qt::RightDockWidgetArea, shown.dock);
      }
    } else if (shown.entry.place != PanelPlace::kPicture) {
      tabifyDockWidget(before, shown.dock);
    }
    before = shown.dock;
    shown.dock->setVisible(shown.entry.shown);
  }
  // Side by side once the graphs lie below them all.
  QDockWidget* left = first[room(PanelPlace::kPicture)];
  for (const auto& shown : panels_) {
    if (!shown.dock || shown.entry.place != PanelPlace::kPicture || shown.dock == left) continue;
    splitDockWidget(left, shown.dock, Qt::Horizontal);
    left = shown.dock;
    shown.dock->setVisible(shown.entry.shown);
  }
  shareOut();
}

void MainWindow::shareOut() {
  QList<QDockWidget*> columns, rows, pictures;
  for (const auto& shown : panels_) {
    if (!shown.dock || !shown.entry.shown) continue;
    const bool begins = shown.entry.place == PanelPlace::kMain || pictures.isEmpty();
    if (begins) columns << shown.dock;
    if (shown.entry.place == PanelPlace::kPicture) pictures << shown.dock;
    if (shown.entry.place == PanelPlace::kGraph) rows << shown.dock;
  }
  if (pictures.isEmpty() || columns.size() < 2) return;
  rows.prepend(pictures.front());
  // Pictures of 4:3 with their strip, in half the width.
  const int side = width() * 52 / 100;
  const int picture_height = side / 2 * 3 / 4;
  resizeDocks({columns.front(), pictures.front()}, {width() - side, side}, Qt::Horizontal);
  QList<int> heights;
  for (int i = 0; i < rows.size(); ++i) heights << (i == 0 ? picture_height : height() / 2);
  resizeDocks(rows, heights, Qt::Vertical);
  QList<int> widths;
  for (int i = 0; i < pictures.size(); ++i) widths << side / static_cast<int>(pictures.size());
  resizeDocks(pictures, widths, Qt::Horizontal);
}

void MainWindow::buildMenus() {
  auto* console = menus_->addMenu(tr("&Console"));
  auto* quit = console->addAction(tr("&Quit"), this, &QWidget::close);
  quit->setShortcut(QKeySequence("Ctrl+Q"));

  auto* view = menus_->addMenu(tr("&View"));
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

  if (task_bar_) {
    auto* task = menus_->addMenu(tr("Task"));
    for (auto* action : task_bar_->menuActions()) task->addAction(action);
  }
  for (const auto& shown : panels_) {
    const auto actions = shown.panel ? shown.panel->menuActions() : QVector<QAction*>();
    if (actions.isEmpty()) continue;
    auto* own = menus_->addMenu(shown.entry.title);
    for (auto* action : actions) own->addAction(action);
  }

  auto* help = menus_->addMenu(tr("&Help"));
  auto* keys =
      help->addAction(tr("Keyboard shortcuts"), this, [this] { showShortcuts(*this, *menus_); });
  keys->setShortcut(QKeySequence("F1"));
  help->addAction(tr("About Pilothouse"), this, [this] { showAbout(*this); });
  for (auto* action : findChildren<QAction*>()) {
    action->setAutoRepeat(action->property(kRepeats).toBool());
  }
}

void repeatWhileHeld(QAction* action) {
  action->setProperty(kRepeats, true);
}

bool MainWindow::complete() const {
  for (const auto& shown : panels_) {
    if (shown.dock && shown.dock->isVisible() && !shown.panel->complete()) return false;
  }
  return true;
}

void MainWindow::refreshPictures() {
  const double now = steadySeconds();
  if (keys_) keys_->review();
  for (const auto& shown : panels_) {
    if (shown.panel) shown.panel->refreshPicture(now);
  }
}

void MainWindow::refreshNumbers() {
  const double now = steadySeconds();
  for (const auto& shown : panels_) {
    if (shown.panel) shown.panel->refreshNumbers(now);
  }
  if (bar_) bar_->refresh(now);
  if (task_bar_) {
    task_bar_->refresh(now);
    task_row_->setVisible(task_bar_->wanted());
  }
  status_->show(situationOf(context_.state, context_.robot.name, now));
}

void MainWindow::refreshNow() {
  refreshPictures();
  refreshNumbers();
}

// The docks' widths can be restored only in a window that has its size, which it gets when shown.
// Without a window manager what was restored may lie partly off the screen.
void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (!remember_ || restored_) return;
  restored_ = true;
  QTimer::singleShot(0, this, [this] {
    const QRect room = QGuiApplication::primaryScreen()->availableVirtualGeometry();
    const QSize size = frameGeometry().size();
    const QPoint place = frameGeometry().topLeft();
    move(std::max(room.left(), std::min(place.x(), room.right() + 1 - size.width())),
         std::max(room.top(), std::min(place.y(), room.bottom() + 1 - size.height())));
    restoreState(QSettings().value("window/docks").toByteArray(), kLayoutVersion);
  });
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
