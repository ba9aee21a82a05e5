#pragma once

#include <QVector>
#include <QWidget>
#include <memory>

#include "gui/view/aim_tool.hpp"
#include "gui/view/panel.hpp"
#include "gui/view/place_canvas.hpp"

class QAction;
class QMenu;
class QToolButton;

namespace pilothouse::gui {

class MapFiles;
class RouteCard;
class RouteTool;

/// The map that stays in place with its tools: goal, route, pose; layers; and their keys.
class PlaceView : public QWidget {
  Q_OBJECT

 public:
  explicit PlaceView(const PanelContext& context, QWidget* parent = nullptr);
  ~PlaceView() override;

  /// Takes what is new (steady [s]).
  void refresh(double now, const DriveOverlay& drive, bool judged);
  PlaceCanvas* canvas() const { return canvas_; }
  AimTool& goalTool() { return goal_; }
  AimTool& poseTool() { return pose_; }
  RouteTool& routeTool() { return *route_; }
  /// Buttons for the panel's title.
  QWidget* controls() const { return controls_; }
  /// What has a key; the tools' own keys are live only while one is in hand.
  QVector<QAction*> menuActions() const { return actions_; }
  void nudged(int key, Qt::KeyboardModifiers modifiers);

 signals:
  /// A tool was asked for: the map must be seen.
  void wanted();

 protected:
  void hideEvent(QHideEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void addTools();
  void addLayers();
  void addFiles();
  void addToolKeys();
  QAction* addAction(const QString& text, const QList<QKeySequence>& keys,
                     const std::function<void()>& act);
  void addKey(const QString& text, const QList<QKeySequence>& keys, ToolKey key);
  QToolButton* addButton(QAction* action, const QString& text);
  void take(MapTool* tool);
  void key(ToolKey key);
  void placeCard();
  PlaceScene sceneAt(double now, const DriveOverlay& drive, bool judged);

  PanelContext context_;
  PlaceCanvas* canvas_;
  QWidget* controls_;
  AimTool goal_, pose_;
  std::unique_ptr<RouteTool> route_;
  RouteCard* card_;
  MapTool* tool_ = nullptr;
  QVector<QAction*> actions_, tool_keys_;
  QAction *goal_action_, *route_action_, *pose_action_, *follow_action_;
  QMenu* layers_;
  MapFiles* files_ = nullptr;
  double drawn_at_ = -1e9;
};

}  // namespace pilothouse::gui
