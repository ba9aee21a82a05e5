#include <QAction>
#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "gui/view/floor_switch.hpp"
#include "gui/view/header_strip.hpp"
#include "gui/view/height_band.hpp"
#include "gui/view/map_canvas.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kDrawDrive = 1.0 / 24.0;  // s between drawings of what moves without a picture
constexpr double kSilent = 0.6;            // s; an older reading is not drawn as if it were live
constexpr double kRadians = 3.14159265358979323846 / 180.0;

/// The floor as the robot sees it, from above.
class MapPanel : public Panel {
 public:
  explicit MapPanel(const PanelContext& panel_context)
      : Panel(panel_context),
        strip_(new HeaderStrip(tr("Map"))),
        canvas_(new MapCanvas(panel_context.robot)),
        switch_(new FloorSwitch(panel_context.ask_floor)),
        heights_(new QToolButton) {
    auto* controls = new QWidget;
    auto* row = new QHBoxLayout(controls);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(theme::kSpace);
    row->addWidget(switch_);
    row->addWidget(heights_);
    heights_->setText(tr("Height"));
    heights_->setCheckable(true);
    heights_->setProperty("segment", "alone");
    heights_->setFocusPolicy(Qt::NoFocus);
    heights_->setToolTip(tr("Pick out objects of a chosen height (H)"));
    strip_->addControl(controls);
    band_ = new HeightBandBox(canvas_);
    band_->hide();
    connect(band_, &HeightBandBox::changed, this, [this] { showBand(); });
    connect(heights_, &QToolButton::toggled, this, [this] { showBand(); });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(canvas_);
    canvas_->setObjectName("map_canvas");
    addAction(tr("Fit the map"), {Qt::Key_F}, [this] { canvas_->fit(); });
    addAction(tr("Zoom in"), {Qt::Key_Plus, Qt::Key_Equal}, [this] { canvas_->zoomIn(); });
    addAction(tr("Zoom out"), {Qt::Key_Minus}, [this] { canvas_->zoomOut(); });
    addAction(tr("Move the map left"), {Qt::CTRL + Qt::Key_Left}, [this] {
      canvas_->pan({60, 0});
    });
    addAction(tr("Move the map right"), {Qt::CTRL + Qt::Key_Right}, [this] {
      canvas_->pan({-60, 0});
    });
    addAction(tr("Move the map up"), {Qt::CTRL + Qt::Key_Up}, [this] { canvas_->pan({0, 60}); });
    addAction(tr("Move the map down"), {Qt::CTRL + Qt::Key_Down}, [this] {
      canvas_->pan({0, -60});
    });
    addAction(tr("Improved or original method"), {Qt::Key_M}, [this] { switch_->toggleMethod(); });
    addAction(tr("Calibrate the camera's mounting"), {Qt::Key_C},
              [this] { switch_->toggleCalibration(); });
    addAction(tr("Pick out a height"), {Qt::Key_H}, [this] { heights_->toggle(); });
  }

  void refreshPicture(double now) override {
    if (auto floor = context().state.floor.take(now)) canvas_->setFloor(std::move(floor));
    if (auto objects = context().state.objects.take(now)) canvas_->setObjects(std::move(objects));
    if (now - driven_at_ < kDrawDrive) return;
    driven_at_ = now;
    canvas_->setDrive(overlay(now));
    canvas_->update();
  }

  void refreshNumbers(double now) override {
    const auto names = context().state.names.get();
    const auto filtered = names.find("objects/filtered");
    const FeedState objects = context().state.objects.state(now);
    canvas_->setJudged(filtered != names.end() && objects.ever &&
                       objects.topic == filtered->second);
    switch_->show(context().state.floor_settings.get(), now);
    const FeedState state = context().state.floor.state(now);
    strip_->show(state);
    std::optional<double> half_angle;
    const auto depth = context().state.depth.latest();
    if (depth && depth->intrinsics && depth->intrinsics->fx > 0.0) {
      half_angle = std::atan(depth->image.width() * 0.5 / depth->intrinsics->fx);
    }
    canvas_->setCamera(context().state.camera_pose.get(), half_angle);
    canvas_->setState(state, waitingFor(context().state, tr("The floor grid"), {"floor_grid"},
                                        tr("The floor nodelet makes it from depth pictures:\n"
                                           "roslaunch pilothouse robot.launch"),
                                        state));
  }

  bool complete() const override { return canvas_->hasFloor(); }
  QWidget* titleStrip() override { return strip_; }
  QVector<QAction*> menuActions() override { return actions_; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    Panel::resizeEvent(event);
    placeBand();
  }

 private:
  void placeBand() {
    band_->adjustSize();
    band_->move(canvas_->width() - band_->width() - theme::kSpace, theme::kSpace);
  }

  void showBand() {
    band_->setVisible(heights_->isChecked());
    placeBand();
    canvas_->setHeightBand(heights_->isChecked() ? std::make_optional(band_->band())
                                                 : std::nullopt);
  }

  DriveOverlay overlay(double now) const {
    const ConsoleState& state = context().state;
    DriveOverlay drive;
    drive.look_ahead = context().robot.avoidance.look_ahead;
    const auto ranges = state.ranges.get();
    for (const auto& ranger : context().robot.rangers) {
      const auto found = ranges.find(ranger.name);
      if (found == ranges.end()) continue;
      const bool fresh = now - found->second.at < kSilent;
      drive.rangers.push_back({ranger.x, ranger.y, ranger.yaw_deg * kRadians,
                               ranger.field_of_view_deg * kRadians, ranger.max_range,
                               fresh ? found->second.range : kUnknown});
    }
    const FeedState limit = state.limit.state(now);
    const auto reading = state.limit.latest();
    if (!reading || !limit.ever || limit.age_s > kSilent) return drive;
    drive.limit = *reading;
    drive.limits = reading->cause != LimitCause::kFree;
    const auto wishes = state.wanted.get();
    const auto wish = wishes.find(reading->source);
    if (wish != wishes.end() && now - wish->second.at < kSilent && !wish->second.twist.zero()) {
      drive.wish = wish->second.twist;
    }
    return drive;
  }

  template <class Slot>
  void addAction(const QString& text, const QList<QKeySequence>& keys, Slot slot) {
    auto* action = new QAction(text, this);
    action->setShortcuts(keys);
    connect(action, &QAction::triggered, this, slot);
    actions_ << action;
  }

  HeaderStrip* strip_;
  MapCanvas* canvas_;
  FloorSwitch* switch_;
  QToolButton* heights_;
  HeightBandBox* band_ = nullptr;
  double driven_at_ = -1e9;
  QVector<QAction*> actions_;
};

const PanelRegistration kRegistration({"map", QObject::tr("Map"), PanelPlace::kMain, 10, true,
                                       [](const PanelContext& c) { return new MapPanel(c); },
                                       nullptr});

}  // namespace

}  // namespace pilothouse::gui
