#pragma once

#include <QObject>
#include <optional>

#include "core/motion/footprint.hpp"
#include "gui/model/route_preview.hpp"
#include "gui/view/aim_tool.hpp"
#include "gui/view/route_history.hpp"

namespace pilothouse::gui {

/// Edits a route on the map: a click puts a point at the end or on a leg, a drag moves one, keys do
/// all of that too. Every change can be taken back.
class RouteTool : public QObject, public MapTool {
  Q_OBJECT

 public:
  RouteTool(const PlaceState& state, AskPlace ask, Footprint outline);

  void press(Eigen::Vector2d at, double reach) override;
  void drag(Eigen::Vector2d at, double reach) override;
  void release() override;
  void nudge(Eigen::Vector2d by) override;
  void key(ToolKey key) override;
  void paint(QPainter& painter, const MapView& view) override;
  AimWords words() override;
  bool refresh(double now) override;
  void begin(Eigen::Vector2d at) override;
  void end() override;

  RouteHistory& history() { return history_; }
  const RouteDraft& draft() const { return history_.draft(); }
  std::optional<std::size_t> selected() const { return selected_; }
  void select(std::optional<std::size_t> index);
  void setPause(double seconds);
  void setLoop(bool loop);
  void setName(const std::string& name);
  void load(const std::string& name);
  /// Another route of this name is replaced only when it is told twice.
  void save();
  void send();
  /// Index of the point that the robot drives to, where it drives this very route.
  std::optional<std::size_t> underWay() const;
  /// The ways along the route, as far as they have been planned.
  const RoutePreview& ways() const { return ways_; }

 signals:
  /// Route, selection or what is under way.
  void changed();
  /// The operator wants to choose among the saved routes.
  void loadWanted();

 private:
  /// A save that waits for the list of what there is (steady [s]).
  struct Saving {
    std::string name;
    double since;
  };
  RouteDraft shown() const;
  void follow(const RouteDraft& before);
  bool addPoint(std::size_t before, Eigen::Vector2d at);
  void letGo();
  void listed(const std::vector<std::string>& files, double now);
  void insertAtCross();
  void order(int by);
  bool refreshWays(double now);
  void turn(double by);
  void paintLegs(QPainter& painter, const MapView& view, const RouteDraft& draft) const;
  void paintPoint(QPainter& painter, const MapView& view, const DraftPoint& point,
                  std::size_t index) const;

  const PlaceState& state_;
  AskPlace ask_;
  Footprint outline_;
  RouteHistory history_;
  RoutePreview ways_;
  std::shared_ptr<const Preview> heard_;
  std::optional<std::size_t> selected_, under_way_;
  std::optional<Eigen::Vector2d> dragged_to_;  ///< the selected point while it is dragged
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero(), cross_ = Eigen::Vector2d::Zero();
  bool in_hand_ = false;  ///< on the map: only then ways are asked for
  bool held_ = false;     ///< by the mouse
  bool turning_ = false;  ///< the drag gives a new point its heading
  bool full_ = false;     ///< a point found no room
  std::string kept_as_;   ///< the robot's file that this route was loaded from or saved to
  std::string replaces_;  ///< another file that a second save replaces
  std::optional<Saving> saving_;
  std::uint32_t shelf_ = 0;
};

}  // namespace pilothouse::gui
