#pragma once

#include <QWidget>
#include <optional>

#include "gui/model/map_view.hpp"

namespace pilothouse::gui {

/// A picture in metres that is fitted, zoomed about the cursor by the wheel, and dragged.
class MovableCanvas : public QWidget {
  Q_OBJECT

 public:
  const MapView& view() const { return view_; }

 public slots:
  /// Shows all there is, and goes on so until it is moved by hand.
  virtual void fit() = 0;
  void zoomIn();
  void zoomOut();
  void pan(QPoint pixels);

 protected:
  MovableCanvas(MapView::Axes axes, QWidget* parent);

  /// What a zoom keeps in its place. @param cursor of the wheel, else the middle.
  virtual QPointF zoomedAbout(QPointF cursor) const { return cursor; }
  /// It was dragged: nothing else moves it from now on.
  virtual void dragged() {}
  void panBy(QPointF pixels);
  QPointF middlePixel() const { return QRectF(rect()).center(); }

  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;

  MapView view_;
  std::optional<QPointF> cursor_;
  QPointF dragged_from_;
  bool fitted_ = true;  ///< follow the content until the operator zooms or drags

 private:
  void zoom(QPointF about, double factor);
};

}  // namespace pilothouse::gui
