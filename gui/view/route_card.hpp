#pragma once

#include <QWidget>

class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QMenu;
class QToolButton;

namespace pilothouse::gui {

class RouteTool;
struct PlaceState;

/// What of a route the map cannot show: its name, saving, loading, loop, pause of the chosen point.
/// Floats in the map's corner.
class RouteCard : public QWidget {
  Q_OBJECT

 public:
  RouteCard(RouteTool& tool, const PlaceState& state, QWidget* parent = nullptr);
  /// Opens the menu of saved routes, asking the robot for them.
  void chooseRoute();
  void save();

 public slots:
  void refresh();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void fillMenu();
  QToolButton* button(const QString& text, const QString& tip);

  RouteTool& tool_;
  const PlaceState& state_;
  QLineEdit* name_;
  QDoubleSpinBox* pause_;
  QLabel* point_;
  QToolButton *save_, *load_, *loop_, *undo_, *redo_, *remove_, *send_;
  QMenu* menu_;
};

}  // namespace pilothouse::gui
