#include "gui/view/overlay.hpp"

#include <algorithm>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr int kPadX = 8;
constexpr int kPadY = 3;

}  // namespace

void paintEmpty(QPainter& painter, const QRectF& area, const EmptyWords& words) {
  const double wide = std::min(420.0, area.width() - 4 * theme::kSpace);
  const QRectF column(area.center().x() - wide / 2, area.top(), wide, area.height());
  const int flags = Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap;
  painter.setFont(theme::headingFont());
  const QRectF heading = painter.boundingRect(column, flags, words.heading);
  painter.setFont(theme::textFont());
  const QRectF body = painter.boundingRect(column, flags, words.body);
  const double gap = theme::kSpace;
  const double top =
      std::max(area.top() + 4, area.center().y() - (heading.height() + gap + body.height()) / 2);
  painter.setFont(theme::headingFont());
  painter.setPen(theme::kText);
  painter.drawText(QRectF(column.left(), top, wide, heading.height()), flags, words.heading);
  painter.setFont(theme::textFont());
  painter.setPen(theme::kMuted);
  painter.drawText(QRectF(column.left(), top + heading.height() + gap, wide, body.height() + 2),
                   flags, words.body);
}

void paintEmptyCard(QPainter& painter, const QRectF& area, const EmptyWords& words) {
  QRectF card(0, 0, std::min(460.0, area.width() - 2 * theme::kSpace),
              std::min(150.0, area.height() - 2 * theme::kSpace));
  card.moveCenter(area.center());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme::kLine, 1));
  painter.setBrush(QColor(26, 30, 36, 245));
  painter.drawRoundedRect(card, 8, 8);
  paintEmpty(painter, card, words);
}

QRectF paintPill(QPainter& painter, QPointF at, Qt::Alignment anchor, const QString& text,
                 const QColor& colour) {
  painter.setFont(theme::smallFont());
  const QFontMetricsF metrics(theme::smallFont());
  QRectF pill(0, 0, metrics.horizontalAdvance(text) + 2 * kPadX, metrics.height() + 2 * kPadY);
  if (anchor & Qt::AlignRight) {
    pill.moveRight(at.x());
  } else if (anchor & Qt::AlignHCenter) {
    pill.moveLeft(at.x() - pill.width() / 2);
  } else {
    pill.moveLeft(at.x());
  }
  if (anchor & Qt::AlignBottom) {
    pill.moveBottom(at.y());
  } else {
    pill.moveTop(at.y());
  }
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 17, 215));
  painter.drawRoundedRect(pill, 5, 5);
  painter.setPen(colour);
  painter.drawText(pill, Qt::AlignCenter, text);
  painter.restore();
  return pill;
}

void paintStale(QPainter& painter, const QRectF& area, const FeedState& state) {
  painter.save();
  painter.fillRect(area, QColor(18, 21, 25, 150));
  painter.setClipRect(area);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(255, 123, 110, 46), 2));
  for (double x = area.left() - area.height(); x < area.right(); x += 22) {
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x + area.height(), area.top()));
  }
  painter.setPen(QPen(theme::kError, 2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(area.adjusted(1, 1, -1, -1));
  painter.restore();
  const QString age = state.age_s < 100.0
                          ? QObject::tr("%1 s").arg(static_cast<int>(state.age_s))
                          : QObject::tr("%1 min").arg(static_cast<int>(state.age_s / 60.0));
  paintPill(painter, {area.center().x(), area.top() + theme::kSpace},
            Qt::AlignHCenter | Qt::AlignTop, QObject::tr("Stale: nothing new for %1").arg(age),
            theme::kError);
}

void paintRejected(QPainter& painter, const QRectF& area, const std::string& reason) {
  const QFontMetricsF metrics(theme::smallFont());
  const QString text =
      metrics.elidedText(QObject::tr("Rejected: %1").arg(QString::fromStdString(reason)),
                         Qt::ElideRight, std::max(60.0, area.width() - 4 * theme::kSpace));
  paintPill(painter, {area.center().x(), area.top() + theme::kSpace},
            Qt::AlignHCenter | Qt::AlignTop, text, theme::kError);
}

EmptyWords waitingFor(const ConsoleState& state, const QString& what,
                      const std::vector<std::string>& topics, const QString& advice,
                      const FeedState& feed) {
  const LinkStatus link = state.link.get();
  if (link.phase != LinkPhase::kConnected) {
    return {QObject::tr("Waiting for the ROS master"),
            QObject::tr("Nothing answers at %1. The console connects by itself as soon as a master "
                        "starts.")
                .arg(QString::fromStdString(link.master_uri))};
  }
  if (!feed.rejection.empty()) {
    return {QObject::tr("%1 rejected").arg(what), QString::fromStdString(feed.rejection)};
  }
  QStringList names;
  for (const auto& topic : topics) names << QString::fromStdString(shownTopic(state, topic));
  return {QObject::tr("Waiting for %1").arg(what.toLower()),
          QObject::tr("Topic %1\n%2").arg(names.join(QObject::tr(" or ")), advice)};
}

}  // namespace pilothouse::gui
