#include "gui/view/task_bar.hpp"

#include <QAction>
#include <QHBoxLayout>
#include <QPainter>
#include <QToolButton>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kRefusalShown = 8.0;  // s
constexpr double kGateFresh = 1.0;     // s
constexpr double kSlow = 1.5;          // s; an ask that takes longer is told

QColor colourOf(Severity severity) {
  switch (severity) {
    case Severity::kGood:
      return theme::kGood;
    case Severity::kNote:
      return theme::kAccent;
    case Severity::kWarning:
      return theme::kWarning;
    case Severity::kError:
      break;
  }
  return theme::kError;
}

}  // namespace

TaskSituation taskSituationOf(const ConsoleState& state, double now) {
  TaskSituation s;
  s.task_state = state.place.task.state(now);
  s.navigation_state = state.place.navigation.state(now);
  if (const auto task = state.place.task.latest()) s.task = *task;
  if (const auto navigation = state.place.navigation.latest()) s.navigation = *navigation;
  const FeedState gate = state.gate.state(now);
  if (const auto stop = state.gate.latest()) {
    s.gate_stopped = gate.age_s < kGateFresh && stop->phase == GatePhase::kStopped;
  }
  const AskAnswer answer = state.place.answer.get();
  if (!answer.done && now - answer.at < kRefusalShown) s.refused = answer.text;
  for (const auto& [what, since] : state.place.asking.get()) {
    if (now - since > kSlow) s.refused = "the robot has not answered to \"" + what + "\" yet";
  }
  return s;
}

TaskBar::TaskBar(const PanelContext& context, QWidget* parent)
    : QWidget(parent), context_(context) {
  setFixedHeight(38);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(theme::kSpace, 4, theme::kSpace + 4, 6);
  row->setSpacing(6);
  row->addStretch(1);
  pause_ = addCall(tr("Pause or go on"), tr("The task waits, or goes on (F5)"), Qt::Key_F5,
                   [this] { ask(words_.can_resume ? TaskCall::kResume : TaskCall::kPause); });
  skip_ = addCall(tr("Skip the point"), tr("On to the route's next point (F6)"), Qt::Key_F6,
                  [this] { ask(TaskCall::kSkip); });
  cancel_ = addCall(tr("Cancel the task"), tr("The task ends, the robot halts (F8)"), Qt::Key_F8,
                    [this] { ask(TaskCall::kCancel); });
  pause_->setObjectName("task_pause");
  skip_->setObjectName("task_skip");
  cancel_->setObjectName("task_cancel");
  skip_->setText(tr("Skip  F6"));
  cancel_->setText(tr("Cancel  F8"));
  pause_->setText(tr("Pause  F5"));
  pause_->setMinimumWidth(84);
}

QToolButton* TaskBar::addCall(const QString& text, const QString& tip, const QKeySequence& key,
                              const std::function<void()>& call) {
  auto* action = new QAction(text, this);
  action->setShortcut(key);
  connect(action, &QAction::triggered, this, call);
  actions_ << action;
  auto* button = new QToolButton(this);
  button->setToolTip(tip);
  button->setProperty("segment", "alone");
  button->setFocusPolicy(Qt::NoFocus);
  button->setFixedHeight(26);
  connect(button, &QToolButton::clicked, action, &QAction::trigger);
  layout()->addWidget(button);
  return button;
}

void TaskBar::ask(TaskCall call) {
  context_.ask_place([call](PlaceAsks& asks) { asks.task(call); });
}

void TaskBar::refresh(double now) {
  const TaskSituation situation = taskSituationOf(context_.state, now);
  wanted_ = situation.task_state.ever || !situation.task_state.rejection.empty();
  words_ = taskWords(situation);
  pause_->setText(words_.can_resume ? tr("Go on  F5") : tr("Pause  F5"));
  pause_->setEnabled(words_.can_pause || words_.can_resume);
  skip_->setEnabled(words_.can_skip);
  cancel_->setEnabled(words_.can_cancel);
  setToolTip(QString::fromStdString(words_.state + ": " + words_.headline +
                                    (words_.why.empty() ? "" : "\n" + words_.why)));
  setAccessibleName(toolTip());
  update();
}

// From the left: state, what it is about and why; at the right, before the buttons, what is left.
void TaskBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor colour = colourOf(words_.severity);
  const QRectF box(theme::kSpace, 4, pause_->x() - theme::kSpace - 8, height() - 10);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme::kRaised);
  painter.drawRoundedRect(box, 6, 6);
  painter.setBrush(colour);
  painter.drawRoundedRect(QRectF(box.left(), box.top(), 5, box.height()), 2.5, 2.5);
  QRectF text = box.adjusted(16, 0, -12, 0);
  const auto word = [&](const QFont& font, const QColor& pen, Qt::Alignment edge,
                        const std::string& what) {
    if (what.empty() || text.width() < 12) return;
    const QFontMetricsF metrics(font);
    const QString shown =
        metrics.elidedText(QString::fromStdString(what), Qt::ElideRight, text.width());
    painter.setFont(font);
    painter.setPen(pen);
    painter.drawText(text, edge | Qt::AlignVCenter, shown);
    const double wide = metrics.horizontalAdvance(shown) + 14;
    text.adjust(edge == Qt::AlignLeft ? wide : 0, 0, edge == Qt::AlignLeft ? 0 : -wide, 0);
  };
  word(theme::titleFont(), colour, Qt::AlignLeft, words_.state);
  word(theme::titleFont(), theme::kText, Qt::AlignRight, words_.left);
  word(theme::textFont(), theme::kText, Qt::AlignLeft, words_.headline);
  word(theme::textFont(), theme::kMuted, Qt::AlignLeft, words_.why);
}

}  // namespace pilothouse::gui
