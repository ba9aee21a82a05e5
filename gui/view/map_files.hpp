#pragma once

#include <QObject>
#include <QString>

#include "gui/view/aim_tool.hpp"

class QWidget;

namespace pilothouse::gui {

/// Saves, loads and clears the robot's map, each after a question; what came of it is told by the
/// status line. The questions hold nobody up: the robot is seen and stopped as ever beside them
/// (showBeside).
class MapFiles : public QObject {
  Q_OBJECT

 public:
  /// @param over the questions appear over its window.
  MapFiles(AskPlace ask, QWidget* over);

  void save();
  void load();
  void clear();

 private:
  void askName(const QString& title, const QString& text, const QString& act,
               const std::function<void(PlaceAsks&, const std::string&)>& what);

  AskPlace ask_;
  QWidget* over_;
  QString last_ = "map";  ///< the name that was given last
};

}  // namespace pilothouse::gui
