#include "gui/view/stop_button.hpp"

#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kRadius = 7.0;
const QColor kRed(0xd6, 0x2f, 0x26), kRedHover(0xea, 0x41, 0x37), kRedDown(0xa8, 0x1f, 0x18);

QFont bold(int pixels) {
  QFont font = theme::headingFont();
  font.setPixelSize(pixels);
  font.setBold(true);
  return font;
}

}  // namespace

StopButton::StopButton(QWidget* parent) : QAbstractButton(parent) {
  setFocusPolicy(Qt::NoFocus);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  setToolTip(tr("Stops the robot at once, until it is armed again (Space, Escape)"));
  setAccessibleName(tr("Stop"));
}

QSize StopButton::sizeHint() const {
  return {128, 48};
}

void StopButton::show(State state) {
  if (state_ == state) return;
  state_ = state;
  update();
}

void StopButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
  painter.setPen(state_ != State::kReady ? QPen(QColor(0xff, 0xd9, 0xd5), 2) : QPen(kRedDown, 1));
  painter.setBrush(isDown() ? kRedDown : underMouse() ? kRedHover : kRed);
  painter.drawRoundedRect(box, kRadius, kRadius);
  QPolygonF sign;
  const QPointF middle(26, box.center().y());
  for (int i = 0; i < 8; ++i) {
    const double angle = (i + 0.5) * 3.14159265358979 / 4.0;
    sign << middle + QPointF(13 * std::cos(angle), 13 * std::sin(angle));
  }
  painter.setPen(QPen(Qt::white, 2));
  painter.setBrush(kRedDown);
  painter.drawPolygon(sign);
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  painter.drawRect(QRectF(middle.x() - 4.5, middle.y() - 4.5, 9, 9));
  painter.setPen(Qt::white);
  const QRectF text(46, box.top() + 4, box.right() - 50, box.height() - 8);
  painter.setFont(bold(state_ == State::kStopped ? 16 : 21));
  painter.drawText(text.adjusted(0, 0, 0, -14), Qt::AlignCenter,
                   state_ == State::kStopped ? tr("STOPPED") : tr("STOP"));
  painter.setFont(theme::smallFont());
  painter.drawText(text, Qt::AlignHCenter | Qt::AlignBottom,
                   state_ == State::kUnconfirmed ? tr("not confirmed") : tr("Space"));
}

HoldButton::HoldButton(QWidget* parent) : QAbstractButton(parent) {
  setFocusPolicy(Qt::NoFocus);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  ticks_.setInterval(16);
  connect(&ticks_, &QTimer::timeout, this, &HoldButton::progress);
  release_.setInterval(kDebounce);
  release_.setSingleShot(true);
  connect(&release_, &QTimer::timeout, this, &HoldButton::letGo);
  connect(this, &QAbstractButton::pressed, this, &HoldButton::press);
  connect(this, &QAbstractButton::released, this, &HoldButton::letGo);
}

QSize HoldButton::sizeHint() const {
  return {104, 48};
}

void HoldButton::show(const QString& text, const QString& key, bool possible) {
  if (possible != isEnabled()) {
    drop(false);
    setEnabled(possible);
  }
  if (text == this->text() && key == key_) return;
  setText(text);
  key_ = key;
  update();
}

void HoldButton::keyDown(bool repeated) {
  const bool again = repeated || release_.isActive();
  release_.stop();
  if (!again) return press();
  down_ = true;
}

void HoldButton::keyUp() {
  if (down_) release_.start();
}

void HoldButton::drop(bool released) {
  holding_ = false;
  if (released) down_ = false;
  ticks_.stop();
  update();
}

void HoldButton::press() {
  if (std::exchange(down_, true) || !isEnabled()) return;
  holding_ = true;
  held_ = 0;
  last_look_.start();
  ticks_.start();
  update();
  emit begun();
}

void HoldButton::letGo() {
  release_.stop();
  drop(true);
}

// A window that hung does not know whether it was held meanwhile, nor while a release is in doubt.
void HoldButton::progress() {
  const auto passed = static_cast<int>(last_look_.restart());
  if (passed <= kLate && !release_.isActive()) held_ += passed;
  if (held_ >= kHold) {
    drop(false);
    emit confirmed();
  }
  update();
}

void HoldButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
  QPainterPath shape;
  shape.addRoundedRect(box, kRadius, kRadius);
  painter.fillPath(
      shape, isEnabled() ? QColor(underMouse() ? 0x364252 : 0x2b3440) : QColor(0x1f, 0x24, 0x2b));
  if (holding_) {
    painter.save();
    painter.setClipPath(shape);
    const double share = std::min(1.0, static_cast<double>(held_) / kHold);
    painter.fillRect(QRectF(box.left(), box.top(), box.width() * share, box.height()),
                     QColor(0x2f, 0x8f, 0x63));
    painter.restore();
  }
  painter.setPen(QPen(isEnabled() ? theme::kGood : theme::kLine, isEnabled() ? 1.6 : 1.0));
  painter.drawPath(shape);
  painter.setPen(isEnabled() ? theme::kText : QColor(0x8b, 0x96, 0xa4));
  painter.setFont(theme::titleFont());
  painter.drawText(box.adjusted(4, 5, -4, -18), Qt::AlignCenter, text());
  painter.setFont(theme::smallFont());
  painter.setPen(isEnabled() ? theme::kMuted : QColor(0x6f, 0x7a, 0x88));
  painter.drawText(box.adjusted(4, 0, -4, -5), Qt::AlignHCenter | Qt::AlignBottom, key_);
}

}  // namespace pilothouse::gui
