#include "gui/view/route_card.hpp"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPainter>
#include <QRegularExpressionValidator>
#include <QSignalBlocker>
#include <QToolButton>

#include "gui/view/route_tool.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

RouteCard::RouteCard(RouteTool& tool, const PlaceState& state, QWidget* parent)
    : QWidget(parent),
      tool_(tool),
      state_(state),
      name_(new QLineEdit),
      pause_(new QDoubleSpinBox),
      point_(new QLabel),
      save_(button(tr("Save"), tr("Save on the robot under this name (Ctrl+S)"))),
      load_(button(tr("Load"), tr("Load one of the robot's routes (Ctrl+O)"))),
      loop_(button(tr("Loop"), tr("After the last point the first again (O)"))),
      undo_(button(tr("Undo"), tr("Take the last step back (Ctrl+Z)"))),
      redo_(button(tr("Redo"), tr("Make it again (Ctrl+Shift+Z)"))),
      remove_(button(tr("Remove"), tr("Remove the chosen point (Delete)"))),
      send_(button(tr("Send"), tr("The robot drives the route (Enter)"))),
      menu_(new QMenu(this)) {
  setObjectName("route_card");
  name_->setObjectName("route_name");
  name_->setPlaceholderText(tr("name"));
  name_->setValidator(
      new QRegularExpressionValidator(QRegularExpression("[A-Za-z0-9_-]{0,64}"), name_));
  name_->setFixedWidth(108);
  pause_->setObjectName("route_pause");
  pause_->setRange(0.0, RouteDraft::kMostPause);
  pause_->setDecimals(0);
  pause_->setSuffix(tr(" s"));
  pause_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  pause_->setFixedWidth(58);
  pause_->setKeyboardTracking(false);
  for (QWidget* field : {static_cast<QWidget*>(name_), static_cast<QWidget*>(pause_)}) {
    field->setFocusPolicy(Qt::ClickFocus);
    field->setFixedHeight(24);
  }
  loop_->setCheckable(true);
  point_->setFont(theme::smallFont());
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(10, 7, 8, 7);
  grid->setHorizontalSpacing(5);
  grid->setVerticalSpacing(5);
  int column = 0;
  for (QWidget* w : {static_cast<QWidget*>(name_), static_cast<QWidget*>(save_),
                     static_cast<QWidget*>(load_), static_cast<QWidget*>(send_)}) {
    grid->addWidget(w, 0, column++);
  }
  auto* steps = new QHBoxLayout;
  steps->setSpacing(5);
  for (QToolButton* b : {loop_, undo_, redo_}) steps->addWidget(b);
  steps->addStretch(1);
  grid->addLayout(steps, 1, 0, 1, 4);
  auto* row = new QHBoxLayout;
  row->setSpacing(5);
  row->addWidget(point_);
  row->addWidget(pause_);
  row->addStretch(1);
  row->addWidget(remove_);
  grid->addLayout(row, 2, 0, 1, 4);

  connect(name_, &QLineEdit::textEdited, this,
          [this](const QString& text) { tool_.setName(text.toStdString()); });
  connect(pause_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this](double seconds) { tool_.setPause(seconds); });
  connect(save_, &QToolButton::clicked, this, &RouteCard::save);
  connect(load_, &QToolButton::clicked, this, &RouteCard::chooseRoute);
  connect(send_, &QToolButton::clicked, this, [this] { tool_.send(); });
  connect(loop_, &QToolButton::clicked, this, [this](bool on) { tool_.setLoop(on); });
  connect(undo_, &QToolButton::clicked, this, [this] { tool_.key(ToolKey::kUndo); });
  connect(redo_, &QToolButton::clicked, this, [this] { tool_.key(ToolKey::kRedo); });
  connect(remove_, &QToolButton::clicked, this, [this] { tool_.key(ToolKey::kRemove); });
  connect(&tool_, &RouteTool::changed, this, &RouteCard::refresh);
  connect(&tool_, &RouteTool::loadWanted, this, &RouteCard::chooseRoute);
  refresh();
}

QToolButton* RouteCard::button(const QString& text, const QString& tip) {
  auto* made = new QToolButton(this);
  made->setText(text);
  made->setToolTip(tip);
  made->setProperty("segment", "alone");
  made->setFocusPolicy(Qt::NoFocus);
  made->setFixedHeight(24);
  return made;
}

void RouteCard::save() {
  const std::string fault = routeNameFault(tool_.draft().name);
  const bool sound = fault.empty() && !tool_.draft().empty();
  if (sound) return tool_.save();
  name_->setFocus();  // a route without a name wants one
  name_->selectAll();
}

void RouteCard::chooseRoute() {
  tool_.load({});  // the list; it comes soon
  fillMenu();
  if (!menu_->isVisible()) menu_->popup(load_->mapToGlobal(QPoint(0, load_->height() + 2)));
}

void RouteCard::fillMenu() {
  const auto shelf = state_.shelf.get();
  menu_->clear();
  if (!shelf || shelf->files.empty()) {
    menu_->addAction(shelf ? tr("no saved routes") : tr("asking the robot ..."))->setEnabled(false);
    return;
  }
  for (const auto& file : shelf->files) {
    menu_->addAction(QString::fromStdString(file), this, [this, file] { tool_.load(file); });
  }
}

void RouteCard::refresh() {
  const RouteDraft& draft = tool_.draft();
  if (!name_->hasFocus()) name_->setText(QString::fromStdString(draft.name));
  if (menu_->isVisible()) fillMenu();
  const std::string fault = routeNameFault(draft.name);
  save_->setEnabled(!draft.empty());
  save_->setToolTip(fault.empty() ? tr("Save on the robot under this name (Ctrl+S)")
                                  : QString::fromStdString(fault));
  send_->setEnabled(faultOf(draft).empty());
  loop_->setChecked(draft.loop);
  undo_->setEnabled(tool_.history().stack().canUndo());
  redo_->setEnabled(tool_.history().stack().canRedo());
  const auto chosen = tool_.selected();
  remove_->setEnabled(chosen.has_value());
  pause_->setEnabled(chosen.has_value());
  point_->setText(chosen ? tr("point %1 of %2 pauses").arg(*chosen + 1).arg(draft.points.size())
                         : tr("no point chosen"));
  const QSignalBlocker quiet(pause_);
  pause_->setValue(chosen ? draft.points[*chosen].pause : 0.0);
}

void RouteCard::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme::kLine, 1));
  painter.setBrush(QColor(20, 24, 29, 245));
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
}

}  // namespace pilothouse::gui
