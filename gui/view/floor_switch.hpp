#pragma once

#include <QWidget>
#include <functional>
#include <string>

#include "gui/model/console_state.hpp"

class QToolButton;

namespace pilothouse::gui {

/// Switches how the floor nodelet judges, while it runs: improved or original, calibration on or
/// off. Shows what the nodelet has announced, not what was clicked.
class FloorSwitch : public QWidget {
  Q_OBJECT

 public:
  /// @param ask is called with (method, calibrate); null leaves the switch disabled.
  explicit FloorSwitch(std::function<void(const std::string&, bool)> ask,
                       QWidget* parent = nullptr);
  void show(const FloorSettings& settings, double now);

 public slots:
  void toggleMethod();
  void toggleCalibration();

 private:
  void want(bool original, bool calibrate);

  std::function<void(const std::string&, bool)> ask_;
  QToolButton* improved_;
  QToolButton* original_;
  QToolButton* calibrate_;
  double asked_at_ = -1e9;  ///< steady time; a wish is shown until it can have been granted
};

}  // namespace pilothouse::gui
