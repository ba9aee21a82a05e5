#include "gui/view/floor_switch.hpp"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>
#include <QVariant>

#include "gui/model/clock.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kGrantedWithin = 1.5;  // s

QToolButton* button(const QString& text, const char* name, const char* place) {
  auto* made = new QToolButton;
  made->setText(text);
  made->setCheckable(true);
  made->setFont(theme::smallFont());
  made->setObjectName(QString(name));
  made->setProperty("segment", QString(place));
  made->setFixedHeight(24);
  made->setFocusPolicy(Qt::NoFocus);  // M and C are its keys
  return made;
}

}  // namespace

FloorSwitch::FloorSwitch(std::function<void(const std::string&, bool)> ask, QWidget* parent)
    : QWidget(parent),
      ask_(std::move(ask)),
      improved_(button(tr("Improved"), "floor_improved", "left")),
      original_(button(tr("Original"), "floor_original", "right")),
      calibrate_(button(tr("Calibrate"), "floor_calibrate", "alone")) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(improved_);
  layout->addWidget(original_);
  layout->addSpacing(theme::kSpace);
  layout->addWidget(calibrate_);
  auto* group = new QButtonGroup(this);
  group->addButton(improved_);
  group->addButton(original_);
  improved_->setChecked(true);
  connect(improved_, &QToolButton::clicked, this, [this] { want(false, calibrate_->isChecked()); });
  connect(original_, &QToolButton::clicked, this, [this] { want(true, calibrate_->isChecked()); });
  connect(calibrate_, &QToolButton::clicked, this,
          [this] { want(original_->isChecked(), calibrate_->isChecked()); });
  show(FloorSettings(), 0.0);
}

void FloorSwitch::show(const FloorSettings& settings, double now) {
  setEnabled(ask_ && settings.known);
  improved_->setToolTip(isEnabled()
                            ? tr("Judge the floor by a flood from where the robot stands (M)")
                            : tr("The floor nodelet has not announced its parameters"));
  original_->setToolTip(isEnabled()
                            ? tr("Judge each cell by the deviation of its heights alone (M)")
                            : improved_->toolTip());
  calibrate_->setToolTip(
      isEnabled() ? tr("Estimate the camera's height and tilt from the floor and use them (C)")
                  : improved_->toolTip());
  if (!settings.known || now - asked_at_ < kGrantedWithin) return;
  improved_->setChecked(!settings.original);
  original_->setChecked(settings.original);
  calibrate_->setChecked(settings.calibrate);
}

void FloorSwitch::toggleMethod() {
  if (isEnabled()) (original_->isChecked() ? improved_ : original_)->click();
}

void FloorSwitch::toggleCalibration() {
  if (isEnabled()) calibrate_->click();
}

void FloorSwitch::want(bool original, bool calibrate) {
  asked_at_ = steadySeconds();
  ask_(original ? "original" : "improved", calibrate);
}

}  // namespace pilothouse::gui
