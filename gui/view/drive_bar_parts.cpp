#include "gui/view/drive_bar_parts.hpp"

#include <QPainter>
#include <cmath>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

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

SpokenCause::SpokenCause(QWidget* parent) : QWidget(parent) {
  setObjectName("spoken_cause");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void SpokenCause::show(const DriveWords& words) {
  if (words.headline == words_.headline && words.advice == words_.advice &&
      words.severity == words_.severity) {
    return;
  }
  words_ = words;
  const QString text = QString::fromStdString(words.headline + "\n" + words.advice);
  setToolTip(text.toHtmlEscaped().replace('\n', "<br>"));
  setAccessibleName(text);
  update();
}

void SpokenCause::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  const QColor colour = colourOf(words_.severity);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme::kRaised);
  painter.drawRoundedRect(box, 7, 7);
  painter.setBrush(colour);
  painter.drawRoundedRect(QRectF(box.left(), box.top(), 5, box.height()), 2.5, 2.5);
  const QRectF text = box.adjusted(18, 4, -12, -5);
  painter.setFont(theme::headingFont());
  painter.setPen(words_.severity == Severity::kGood ? theme::kText : colour);
  painter.drawText(
      text, Qt::AlignLeft | Qt::AlignTop,
      QFontMetricsF(theme::headingFont())
          .elidedText(QString::fromStdString(words_.headline), Qt::ElideRight, text.width()));
  painter.setFont(theme::textFont());
  painter.setPen(theme::kMuted);
  painter.drawText(
      text, Qt::AlignLeft | Qt::AlignBottom,
      QFontMetricsF(theme::textFont())
          .elidedText(QString::fromStdString(words_.advice), Qt::ElideRight, text.width()));
}

KeyLights::KeyLights(bool sideways, QWidget* parent) : QWidget(parent), sideways_(sideways) {
  setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Expanding);
  setToolTip(sideways
                 ? tr("Hold to drive: W S or Up Down forward and back, A D or Left Right turn, "
                      "Q E sideways, Shift slowly")
                 : tr("Hold to drive: W S or Up Down forward and back, A D or Left Right turn, "
                      "Shift slowly"));
}

void KeyLights::show(const HelmView& view) {
  view_ = view;
  update();
}

void KeyLights::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(theme::smallFont());
  const double side = 21.0;
  const double gap = 3.0;
  const double top = (height() - 2 * side - gap) / 2;
  const auto key = [&](int column, int row, const QString& letter, bool lit) {
    const QRectF box(column * (side + gap) + (row == 1 ? 5.0 : 0.0), top + row * (side + gap), side,
                     side);
    painter.setPen(QPen(lit ? theme::kAccent : QColor(0x3d, 0x47, 0x54), 1));
    painter.setBrush(lit ? QColor(0x2b, 0x5f, 0x8f) : theme::kRaised);
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
    painter.setPen(lit ? QColor(Qt::white) : theme::kMuted);
    painter.drawText(box, Qt::AlignCenter, letter);
  };
  const bool on = view_.driving;
  if (sideways_) key(0, 0, "Q", on && view_.side_left);
  key(1, 0, "W", on && view_.forward);
  if (sideways_) key(2, 0, "E", on && view_.side_right);
  key(0, 1, "A", on && view_.left);
  key(1, 1, "S", on && view_.back);
  key(2, 1, "D", on && view_.right);
  if (width() < sizeHint().width()) return;
  const QRectF words(3 * (side + gap) + 8, top, width() - 3 * (side + gap) - 8, 2 * side + gap);
  painter.setPen(on ? theme::kAccent : theme::kMuted);
  painter.drawText(words, Qt::AlignLeft | Qt::AlignTop, on ? tr("driving") : tr("keys"));
  const Twist2& command = view_.command;
  QString speed = tr("%1 m/s").arg(command.linear(), 0, 'f', 2);
  if (command.linear() < 0.005) {
    speed = tr("%1 deg/s").arg(std::abs(command.w) * 57.29578, 0, 'f', 0);
  }
  painter.drawText(words, Qt::AlignLeft | Qt::AlignBottom,
                   !on          ? tr("at rest")
                   : view_.slow ? tr("slowly")
                                : speed);
}

}  // namespace pilothouse::gui
