#include <QAction>
#include <QVBoxLayout>
#include <cmath>

#include "gui/view/floor_switch.hpp"
#include "gui/view/header_strip.hpp"
#include "gui/view/map_canvas.hpp"
#include "gui/view/panel_registry.hpp"

namespace pilothouse::gui {

namespace {

/// The floor as the robot sees it, from above.
class MapPanel : public Panel {
 public:
  explicit MapPanel(const PanelContext& panel_context)
      : Panel(panel_context),
        strip_(new HeaderStrip(tr("Map"))),
        canvas_(new MapCanvas(panel_context.robot)),
        switch_(new FloorSwitch(panel_context.ask_floor)) {
    strip_->addControl(switch_);
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
  }

  void refreshPicture(double now) override {
    if (auto floor = context().state.floor.take(now)) canvas_->setFloor(std::move(floor));
    if (auto objects = context().state.objects.take(now)) canvas_->setObjects(std::move(objects));
  }

  void refreshNumbers(double now) override {
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

 private:
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
  QVector<QAction*> actions_;
};

const PanelRegistration kRegistration({"map", QObject::tr("Map"), PanelPlace::kMain, 10, true,
                                       [](const PanelContext& c) { return new MapPanel(c); },
                                       nullptr});

}  // namespace

}  // namespace pilothouse::gui
