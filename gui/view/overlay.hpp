#pragma once

#include <QPainter>
#include <QString>

#include "gui/model/console_state.hpp"

namespace pilothouse::gui {

/// Words for a panel that has nothing to show.
struct EmptyWords {
  QString heading, body;
};

/// Heading and explanation in the middle of `area`.
void paintEmpty(QPainter& painter, const QRectF& area, const EmptyWords& words);
/// The same on a card that covers what lies below.
void paintEmptyCard(QPainter& painter, const QRectF& area, const EmptyWords& words);
/// A dark pill with text; `anchor` is its corner: e.g. Qt::AlignLeft | Qt::AlignBottom puts its
/// lower left corner at `at`. @return the pill.
QRectF paintPill(QPainter& painter, QPointF at, Qt::Alignment anchor, const QString& text,
                 const QColor& colour);
/// Dims the picture and says since when it has not changed: an old picture never looks live.
void paintStale(QPainter& painter, const QRectF& area, const FeedState& state);
/// Says that the newest message was refused and why.
void paintRejected(QPainter& painter, const QRectF& area, const std::string& reason);

/// Why a panel waits for `topic`, and how to make it come.
EmptyWords waitingFor(const ConsoleState& state, const QString& what,
                      const std::vector<std::string>& topics, const QString& advice,
                      const FeedState& feed);

}  // namespace pilothouse::gui
