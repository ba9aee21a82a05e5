#pragma once

#include <QPainterPath>
#include <memory>
#include <optional>

#include "doors/robot_description.hpp"
#include "gui/model/console_state.hpp"
#include "gui/view/map_drive.hpp"
#include "gui/view/movable_canvas.hpp"
#include "gui/view/overlay.hpp"

namespace pilothouse::gui {

/// The metric map in the robot's own frame: floor classes, objects, the robot to scale with its
/// camera's view, rings and grid in metres. Wheel zooms about the cursor, dragging pans.
class MapCanvas : public MovableCanvas {
  Q_OBJECT

 public:
  explicit MapCanvas(const RobotDescription& robot, QWidget* parent = nullptr);

  void setFloor(std::shared_ptr<const FloorPicture> floor);
  void setObjects(std::shared_ptr<const ObjectsPicture> objects);
  /// @param judged the objects tell whether they are in the way.
  void setJudged(bool judged) { judged_ = judged; }
  void setDrive(DriveOverlay drive);
  void setHeightBand(std::optional<HeightBand> band);
  void setCamera(std::optional<CameraPose> pose, std::optional<double> half_angle);
  void setState(const FeedState& state, const EmptyWords& words);

  bool hasFloor() const { return floor_ != nullptr; }
  /// Coordinates, class, height and deviation under the cursor; empty when it is elsewhere.
  QString readoutText() const;

 public slots:
  void fit() override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  QRectF content() const;
  QPainterPath cone() const;

  RobotDescription robot_;
  Footprint outline_;
  std::shared_ptr<const FloorPicture> floor_;
  std::shared_ptr<const ObjectsPicture> objects_;
  DriveOverlay drive_;
  std::optional<HeightBand> band_;
  bool judged_ = false;
  std::optional<CameraPose> camera_;
  double half_angle_;
  FeedState state_;
  EmptyWords words_;
};

}  // namespace pilothouse::gui
