#include "gui/view/help.hpp"

#include <QAction>
#include <QDialog>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenuBar>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "gui/view/sheet.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

QLabel* keyLabel(const QString& text) {
  auto* label = new QLabel(text);
  label->setFont(theme::smallFont());
  label->setAlignment(Qt::AlignCenter);
  label->setStyleSheet(
      "background: #242a32; border: 1px solid #3d4754; border-radius: 4px; "
      "padding: 2px 8px; color: #e8ecf1;");
  return label;
}

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setFont(theme::titleFont());
  label->setContentsMargins(0, 10, 0, 2);
  return label;
}

void addRow(QGridLayout* grid, const QString& what, const QString& keys) {
  const int row = grid->rowCount();
  grid->addWidget(new QLabel(what), row, 0);
  grid->addWidget(keyLabel(keys), row, 1, Qt::AlignRight);
}

QGridLayout* column() {
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(40);
  grid->setVerticalSpacing(4);
  return grid;
}

void addMenu(QGridLayout* grid, const QAction& top) {
  grid->addWidget(heading(top.text().remove('&')), grid->rowCount(), 0);
  for (const auto* action : top.menu()->actions()) {
    QStringList keys;
    for (const auto& key : action->shortcuts()) keys << key.toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) addRow(grid, action->text().remove('&'), keys.join(QObject::tr("  or  ")));
  }
}

// These are read beside the window, so that no menu has them.
void addDriving(QGridLayout* grid) {
  grid->addWidget(heading(QObject::tr("Stop and drive")), grid->rowCount(), 0);
  const QString or_else = QObject::tr("  or  ");
  addRow(grid, QObject::tr("Stop, at once"), "Space" + or_else + "Esc");
  addRow(grid, QObject::tr("Arm: hold it until the button is full"), "F9");
  addRow(grid, QObject::tr("Forward, back, while held"), "W S" + or_else + QObject::tr("Up Down"));
  addRow(grid, QObject::tr("Turn left, right"), "A D" + or_else + QObject::tr("Left Right"));
  addRow(grid, QObject::tr("Sideways, where the robot can"), "Q E");
  addRow(grid, QObject::tr("Slowly"), "Shift");
}

QDialog* sheet(QMainWindow& window, const QString& title) {
  auto* dialog = new QDialog(&window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(title);
  return dialog;
}

void finish(QDialog* dialog, QVBoxLayout* layout, const QMainWindow& window) {
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  buttons->button(QDialogButtonBox::Close)->setIcon(QIcon());
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  layout->addSpacing(theme::kSpace);
  layout->addWidget(buttons);
  showBeside(*dialog, window);
}

}  // namespace

void showShortcuts(QMainWindow& window, const QMenuBar& bar) {
  auto* dialog = sheet(window, QObject::tr("Keyboard shortcuts"));
  dialog->setObjectName("shortcuts");
  auto* layout = new QVBoxLayout(dialog);
  layout->setContentsMargins(24, 12, 24, 16);
  // The window's own menus at the left, those of the panels at the right.
  auto* own = column();
  auto* panels = column();
  addDriving(own);
  const auto menus = bar.actions();
  for (int i = 0; i < menus.size(); ++i) {
    const bool first_or_last = i < 2 || i + 1 == menus.size();
    if (menus[i]->menu()) addMenu(first_or_last ? own : panels, *menus[i]);
  }
  panels->addWidget(heading(QObject::tr("Mouse on the map")), panels->rowCount(), 0);
  addRow(panels, QObject::tr("Zoom about the cursor"), QObject::tr("wheel"));
  addRow(panels, QObject::tr("Move the map"), QObject::tr("drag"));
  addRow(panels, QObject::tr("Fit the map, without a tool"), QObject::tr("double click"));
  addRow(panels, QObject::tr("With a tool: place, and heading"), QObject::tr("press, drag"));
  addRow(panels, QObject::tr("With a tool: send it"), QObject::tr("click on it"));
  addRow(panels, QObject::tr("With a tool: take it back; move the map"),
         QObject::tr("right click; right drag"));
  addRow(panels, QObject::tr("With a tool: move its cross (finely)"),
         QObject::tr("arrow keys (Shift)"));
  own->setRowStretch(own->rowCount(), 1);
  panels->setRowStretch(panels->rowCount(), 1);

  auto* content = new QWidget;
  auto* columns = new QHBoxLayout(content);
  columns->setContentsMargins(0, 0, 0, 0);
  columns->setSpacing(56);
  columns->addLayout(own);
  columns->addLayout(panels);
  // Scrolls where the screen is small, e.g. 1280x720 at 200 %.
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setWidget(content);
  const QSize wanted = content->sizeHint() + QSize(16, 4);
  scroll->setMinimumSize(wanted.boundedTo(roomBeside(window) - QSize(60, 110)));
  layout->addWidget(scroll);
  finish(dialog, layout, window);
}

void showAbout(QMainWindow& window) {
  auto* dialog = sheet(window, QObject::tr("About Pilothouse"));
  auto* layout = new QVBoxLayout(dialog);
  layout->setContentsMargins(24, 20, 24, 16);
  auto* name = new QLabel(QObject::tr("Pilothouse %1").arg(PILOTHOUSE_VERSION));
  name->setFont(theme::headingFont());
  auto* text =
      new QLabel(QObject::tr("The operator's console of small mobile robots with a depth camera.\n"
                             "It knows the robot only through ROS topics and services.\n\n"
                             "BSD-3-Clause. Uses Qt (LGPL), ROS, OpenCV and yaml-cpp."));
  text->setStyleSheet("color: #a0abb9;");
  layout->addWidget(name);
  layout->addWidget(text);
  finish(dialog, layout, window);
}

}  // namespace pilothouse::gui
