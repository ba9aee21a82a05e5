#pragma once

#include <QImage>
#include <QWidget>
#include <functional>
#include <optional>

#include "gui/model/feed_meter.hpp"
#include "gui/view/overlay.hpp"

namespace pilothouse::gui {

/// Draws one picture as large as fits, with a readout of the pixel under the cursor, and marks it
/// when it is stale or the newest message was refused.
class PictureCanvas : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kLegendWidth = 56;  ///< px

  explicit PictureCanvas(QWidget* parent = nullptr);

  void setPicture(const QImage& image);
  void setState(const FeedState& state, const EmptyWords& words);
  /// Words for the pixel under the cursor.
  void setReadout(std::function<QString(QPoint pixel)> readout) { readout_ = std::move(readout); }
  /// Keeps `width` pixels free at the right, where `paint` draws beside the picture.
  void setLegend(int width, std::function<void(QPainter&, const QRectF&)> paint);

  /// Where the picture lies in the widget.
  QRectF pictureRect() const;
  std::optional<QPoint> pixelAt(QPointF place) const;
  /// What the readout says now; empty when the cursor is not on the picture.
  QString readoutText() const;
  bool hasPicture() const { return !image_.isNull(); }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void paintCursor(QPainter& painter, const QRectF& where);

  QImage image_;
  FeedState state_;
  EmptyWords words_;
  std::function<QString(QPoint)> readout_;
  std::function<void(QPainter&, const QRectF&)> legend_;
  int legend_width_ = 0;
  std::optional<QPointF> cursor_;
};

}  // namespace pilothouse::gui
