#pragma once

#include <QWidget>

#include "gui/model/drive_words.hpp"
#include "gui/view/panel.hpp"

class QLabel;
class QSlider;

namespace pilothouse::gui {

class HoldButton;
class KeyLights;
class SpokenCause;
class StopButton;

/// Always in sight: the stop, arming, what holds or slows the robot and what to do about it, the
/// keys that drive and their speed cap.
class DriveBar : public QWidget {
  Q_OBJECT

 public:
  /// @param context with a helm.
  explicit DriveBar(const PanelContext& context, QWidget* parent = nullptr);
  /// Words and figures as they are now (steady [s]).
  void refresh(double now);
  /// The words as shown: headline and advice.
  DriveWords words() const { return words_; }
  /// Where the stop is in its window, in the screen's own pixels; empty: nowhere.
  QRect stopPlace() const;

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void setCap(int percent);
  void watchHold();
  void pressBesidePopup(QPoint at);

  PanelContext context_;
  DriveWords words_;
  StopSerial hold_began_at_ = 0;  ///< stops when arming began to be held: a later one ends that
  StopButton* stop_;
  HoldButton* arm_;
  SpokenCause* cause_;
  KeyLights* keys_;
  QSlider* cap_;
  QLabel* cap_words_;
};

/// What the words about driving are made from, as it is now.
DriveSituation driveSituationOf(const ConsoleState& state, const Helm& helm, double now);

}  // namespace pilothouse::gui
