#pragma once

#include <bitset>
#include <memory>
#include <optional>

#include "doors/robot_description.hpp"
#include "gui/model/place_state.hpp"
#include "gui/view/legend.hpp"
#include "gui/view/map_drive.hpp"
#include "gui/view/movable_canvas.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/place_layers.hpp"

namespace pilothouse::gui {

class MapTool;

/// What the map can show, from below.
enum class PlaceLayer { kMap, kFloor, kStanding, kObjects, kTrail, kPath, kRobot };
constexpr std::size_t kPlaceLayers = 7;
constexpr double kWordsHeight = 46.0;  ///< of a tool's words at the top of the map [px]

/// What is drawn. Pictures are shared and never change.
struct PlaceScene {
  std::shared_ptr<const MapPicture> map;
  std::shared_ptr<const FloorPicture> floor;       ///< null: none, or too old
  std::shared_ptr<const ObjectsPicture> objects;   ///< in the robot's frame; null: too old
  std::shared_ptr<const ObjectsPicture> standing;  ///< in the map's
  std::shared_ptr<const PathReading> path;
  std::shared_ptr<const PoseReading> pose;
  std::shared_ptr<const NavigationReading> under_way;  ///< null: nothing is driven to
  DriveOverlay drive;
  bool judged = false;  ///< the objects tell whether they are in the way
  FeedState pose_state;
  std::uint32_t place = 0;  ///< another one: the trail was elsewhere
  EmptyWords words;         ///< for a map without anything
  std::string refused;      ///< what is not shown and why; empty: all is
};

/// The map that stays in place: x right, y up, the robot moves on it. Wheel zooms about the cursor,
/// dragging pans; with a tool the left button is the tool's.
class PlaceCanvas : public MovableCanvas {
  Q_OBJECT

 public:
  explicit PlaceCanvas(const RobotDescription& robot, QWidget* parent = nullptr);

  void show(PlaceScene scene);
  const PlaceScene& scene() const { return scene_; }
  void setLayer(PlaceLayer layer, bool on);
  bool layer(PlaceLayer layer) const { return layers_[static_cast<std::size_t>(layer)]; }
  /// @param tool null: none; must outlive the canvas or be taken away.
  void setTool(MapTool* tool);
  /// The robot stays in the middle.
  void setFollow(bool on);
  bool follows() const { return follow_; }
  const Trail& trail() const { return trail_; }
  /// Place and class under the cursor; empty when it is elsewhere.
  QString readoutText() const;
  /// Where a tool begins: the middle of what is seen.
  Eigen::Vector2d middle() const;
  /// An arrow key: the tool's cross moves by so many steps.
  void nudge(int right, int up, bool fine);

 public slots:
  void fit() override;

 signals:
  void takenBack();      ///< the right button
  void followChanged();  ///< by a drag

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  /// The robot stays in the middle where it is followed.
  QPointF zoomedAbout(QPointF cursor) const override { return follow_ ? middlePixel() : cursor; }
  void dragged() override { setFollow(false); }

 private:
  Eigen::Vector2d metresAt(QPointF pixel) const;
  double reach(double pixels) const { return pixels / view_.scale(); }
  void paintScene(QPainter& painter);
  void paintRobotAt(QPainter& painter);
  void paintWords(QPainter& painter);
  void paintSigns(QPainter& painter);
  QVector<LegendEntry> legend() const;

  RobotDescription robot_;
  Footprint outline_;
  PlaceScene scene_;
  Trail trail_;
  std::bitset<kPlaceLayers> layers_;
  MapTool* tool_ = nullptr;
  bool panning_ = false, panned_ = false, aiming_ = false;
  bool follow_ = false;
};

}  // namespace pilothouse::gui
