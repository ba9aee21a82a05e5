#include "gui/view/status_line.hpp"

#include <QPainter>
#include <algorithm>

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

QString capitalised(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

const QString kBetween = QStringLiteral("   \u00b7   ");
constexpr int kLongest = 400;   // characters; no line holds more
constexpr int kMostInTip = 30;  // notices

}  // namespace

QString StatusLine::sentence() const {
  return sentences_.join(kBetween);
}

StatusLine::StatusLine(QWidget* parent) : QWidget(parent) {
  setFixedHeight(theme::kStripHeight);
  setObjectName("status_line");
}

QSize StatusLine::sizeHint() const {
  return {600, theme::kStripHeight};
}

void StatusLine::show(const Situation& situation) {
  const auto all = notices(situation);
  severity_ = all.front().severity;
  QString tip;
  QStringList sentences;
  for (const auto& notice : all) {
    const QString text = QString::fromStdString(notice.text);
    if (sentences.size() < kMostInTip) {
      tip += "<p>" + capitalised(text.left(kLongest)).toHtmlEscaped() + "</p>";
    }
    sentences << (sentences.isEmpty() ? capitalised(text) : text);
  }
  const int hidden = sentences.size() - kMostInTip;
  if (hidden > 0) tip += "<p>" + tr("and %1 more").arg(hidden) + "</p>";
  sentences_ = sentences;
  robot_ = QString::fromStdString(situation.robot);
  clock_ = situation.link.simulated_time ? tr("simulated time") : tr("wall clock");
  linked_ = situation.link.phase == LinkPhase::kConnected;
  QString uri = QString::fromStdString(situation.link.master_uri);
  uri.remove("http://");
  link_ = linked_
              ? tr("%1  %2 ms").arg(uri).arg(std::max(0.1, situation.link.round_trip_ms), 0, 'f', 1)
              : tr("not connected");
  setToolTip(tip);
  setAccessibleName(sentence());
  update();
}

// As many as the line can hold; the rest is counted and stands in the tool tip. Nothing is measured
// beyond the first that does not fit.
QString StatusLine::fitted(const QFontMetrics& metrics, int width) const {
  const auto counted = [](int hidden) {
    return hidden > 0 ? kBetween + tr("and %1 more").arg(hidden) : QString();
  };
  QString text;
  for (int i = 0; i < sentences_.size(); ++i) {
    const QString longer = (i > 0 ? text + kBetween : QString()) + sentences_[i].left(kLongest);
    const int hidden = sentences_.size() - i - 1;
    if (metrics.horizontalAdvance(longer + counted(hidden)) > width) {
      return i > 0 ? text + counted(hidden + 1)
                   : metrics.elidedText(longer + counted(hidden), Qt::ElideRight, width);
    }
    text = longer;
  }
  return text;
}

void StatusLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::kRaised);
  painter.setFont(theme::smallFont());
  const QFontMetrics small(theme::smallFont());
  const double middle = height() * 0.5;
  // From the right: link, clock, robot.
  int right = width() - theme::kSpace - 4;
  const auto item = [&](const QString& text, const QColor& colour, const QColor& dot) {
    const int wide = small.horizontalAdvance(text);
    painter.setPen(colour);
    painter.drawText(QRect(right - wide, 0, wide, height()), Qt::AlignVCenter, text);
    right -= wide;
    if (dot.isValid()) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(dot);
      painter.drawEllipse(QPointF(right - 9, middle), 3.5, 3.5);
      right -= 16;
    }
    right -= 12;
    painter.setPen(theme::kLine);
    painter.drawLine(QPointF(right, 9), QPointF(right, height() - 9));
    right -= 12;
  };
  // Where the line is short the sentence matters more.
  const bool roomy = width() >= 900;
  item(roomy || !linked_ ? link_ : tr("connected"), linked_ ? theme::kText : theme::kWarning,
       linked_ ? theme::kGood : theme::kWarning);
  if (roomy) item(clock_, theme::kMuted, {});
  item(robot_, theme::kText, {});

  const QColor colour = colourOf(severity_);
  const double left = theme::kSpace + 4;
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawEllipse(QPointF(left + 4, middle), 4.5, 4.5);
  painter.setFont(theme::textFont());
  const QFontMetrics metrics(theme::textFont());
  const QRect room(static_cast<int>(left) + 18, 0, right - static_cast<int>(left) - 20, height());
  painter.setPen(severity_ == Severity::kGood ? theme::kText : colour);
  painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft, fitted(metrics, room.width()));
}

}  // namespace pilothouse::gui
