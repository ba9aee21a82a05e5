#pragma once

#include <QPainter>

#include "gui/model/goal_aim.hpp"
#include "gui/model/map_view.hpp"

namespace pilothouse::gui {

/// What a key means to a tool, beside the mouse.
enum class ToolKey {
  kEnter,     ///< sends, sets, or puts down what is not there yet
  kTakeBack,  ///< one step back
  kTurnLeft,
  kTurnRight,
  kAnyHeading,
  kNearest,  ///< the nearest place that can be reached
  kLess,     ///< [
  kMore,     ///< ]
  kRemove,
  kInsert,
  kEarlier,
  kLater,
  kLoop,
  kUndo,
  kRedo,
  kSave,
  kLoad,
};

/// What the mouse and the keys do on the map: aim at a goal, edit a route, set the pose. Places are
/// in the map's frame [m].
class MapTool {
 public:
  virtual ~MapTool() = default;
  /// @param reach what counts as on a thing [m].
  virtual void press(Eigen::Vector2d at, double reach) = 0;
  virtual void drag(Eigen::Vector2d at, double reach) = 0;
  virtual void release() = 0;
  /// An arrow key.
  virtual void nudge(Eigen::Vector2d by) = 0;
  virtual void key(ToolKey key) = 0;
  virtual void paint(QPainter& painter, const MapView& view) = 0;
  virtual AimWords words() = 0;
  /// Called many times a second (steady [s]). @return whether something is to be drawn anew.
  virtual bool refresh(double now) = 0;
  /// Begins with the cross there.
  virtual void begin(Eigen::Vector2d at) = 0;
  virtual void end() = 0;
};

}  // namespace pilothouse::gui
