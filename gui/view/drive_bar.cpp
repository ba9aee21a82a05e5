#include "gui/view/drive_bar.hpp"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QSlider>
#include <QVBoxLayout>
#include <QWindow>
#include <cmath>

#include "gui/model/helm.hpp"
#include "gui/view/drive_bar_parts.hpp"
#include "gui/view/stop_button.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {
constexpr double kRefusalShown = 6.0;  // s
constexpr double kUsualCap = 0.3;      // m/s
// Only what the gate itself says is called stopped.
StopButton::State stopShown(const DriveSituation& s, bool held) {
  if (held && (s.helm.stop || s.stop.cause != StopCause::kNotArmed)) {
    return StopButton::State::kStopped;
  }
  return s.helm.stop ? StopButton::State::kUnconfirmed : StopButton::State::kReady;
}

}  // namespace

DriveSituation driveSituationOf(const ConsoleState& state, const Helm& helm, double now) {
  DriveSituation s;
  s.now = now;
  s.connected = linkAt(state.link.get(), now).phase == LinkPhase::kConnected;
  s.limit_state = state.limit.state(now);
  s.stop_state = state.gate.state(now);
  if (const auto limit = state.limit.latest()) s.limit = *limit;
  if (const auto gate = state.gate.latest()) s.stop = *gate;
  s.helm = helm.view();
  s.contacts = state.contacts.get();
  const ArmingState arming = state.arming.get();
  s.arming_for = now - arming.asked_at;
  if (now - arming.refused.at < kRefusalShown) s.arming_refused = arming.refused.reason;
  return s;
}

DriveBar::DriveBar(const PanelContext& context, QWidget* parent)
    : QWidget(parent),
      context_(context),
      stop_(new StopButton),
      arm_(new HoldButton),
      cause_(new SpokenCause),
      keys_(new KeyLights(context.robot.drive.kind != BaseKind::kDifferential)),
      cap_(new QSlider(Qt::Horizontal)),
      cap_words_(new QLabel) {
  setFixedHeight(64);
  stop_->setObjectName("stop_button");
  arm_->setObjectName("arm_button");
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(theme::kSpace, 7, theme::kSpace + 4, 7);
  layout->setSpacing(theme::kSpace);
  layout->addWidget(stop_);
  layout->addWidget(arm_);
  layout->addWidget(cause_, 1);
  layout->addWidget(keys_);
  auto* cap = new QVBoxLayout;
  cap->setSpacing(0);
  cap_words_->setFont(theme::smallFont());
  cap_words_->setFixedWidth(118);
  cap_->setFixedWidth(118);
  cap_->setRange(5, 100);
  cap_->setFocusPolicy(Qt::NoFocus);  // arrow keys drive
  cap_->setToolTip(tr("The fastest that keys and stick drive"));
  cap_->setObjectName("cap_slider");
  cap->addWidget(cap_words_);
  cap->addWidget(cap_);
  layout->addLayout(cap);
  connect(stop_, &QAbstractButton::pressed, this, [this] { context_.helm->stop(); });
  watchHold();
  connect(cap_, &QSlider::valueChanged, this, &DriveBar::setCap);
  const double most = context.robot.drive.max_speed;
  cap_->setValue(static_cast<int>(std::lround(100.0 * std::min(1.0, kUsualCap / most))));
  setCap(cap_->value());
  qApp->installEventFilter(this);
}

// A hold takes back what was pressed before it began; a stop or a lost focus ends it.
void DriveBar::watchHold() {
  connect(arm_, &HoldButton::begun, this, [this] { hold_began_at_ = context_.helm->stops(); });
  connect(arm_, &HoldButton::confirmed, this, [this] {
    const bool stopped_since = context_.helm->stops() != hold_began_at_;
    if (context_.ask_arm && !stopped_since) context_.ask_arm(hold_began_at_);
  });
  connect(qApp, &QGuiApplication::focusWindowChanged, arm_, [this] { arm_->drop(true); });
}

void DriveBar::setCap(int percent) {
  const double cap = context_.robot.drive.max_speed * percent / 100.0;
  context_.helm->setCap(cap);
  cap_words_->setText(tr("by hand <b>%1</b> m/s").arg(cap, 0, 'f', 2));
}

void DriveBar::refresh(double now) {
  const DriveSituation situation = driveSituationOf(context_.state, *context_.helm, now);
  words_ = driveWords(situation);
  if (context_.helm->stops() != hold_began_at_) arm_->drop(false);
  cause_->show(words_);
  keys_->show(situation.helm);
  const bool gate = situation.stop_state.ever && situation.stop_state.age_s < 1.0;
  const bool held = gate && situation.stop.phase == GatePhase::kStopped;
  const bool latched = situation.helm.stop || held;
  stop_->show(stopShown(situation, held));
  arm_->show(latched ? tr("Hold to arm")
             : gate  ? tr("Armed")
                     : tr("Arm"),
             latched || !gate ? tr("F9") : tr("ready"), latched);
}

QRect DriveBar::stopPlace() const {
  if (!stop_->isVisible()) return {};
  const double pixels = devicePixelRatioF();
  const QPoint corner = stop_->mapTo(window(), QPoint(0, 0));
  return {(QPointF(corner) * pixels).toPoint(), (QSizeF(stop_->size()) * pixels).toSize()};
}

// An open menu takes every press; where none of it lies a press on the stop is meant for the stop.
void DriveBar::pressBesidePopup(QPoint at) {
  const QWidget* popup = QApplication::activePopupWidget();
  if (!popup || popup->geometry().contains(at) || !stop_->isVisible()) return;
  if (stop_->rect().contains(stop_->mapFromGlobal(at))) context_.helm->stop();
}

// F9 held means the button held, wherever the focus is.
bool DriveBar::eventFilter(QObject*, QEvent* event) {
  if (event->type() == QEvent::MouseButtonPress) {
    pressBesidePopup(static_cast<QMouseEvent*>(event)->globalPos());
  }
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::KeyRelease) return false;
  const auto& key = *static_cast<QKeyEvent*>(event);
  if (key.key() != Qt::Key_F9) return false;
  if (event->type() == QEvent::KeyPress) {
    arm_->keyDown(key.isAutoRepeat());
  } else if (!key.isAutoRepeat()) {
    arm_->keyUp();
  }
  return true;
}

}  // namespace pilothouse::gui
