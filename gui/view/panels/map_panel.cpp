#include <QAction>
#include <QHBoxLayout>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "gui/view/floor_switch.hpp"
#include "gui/view/header_strip.hpp"
#include "gui/view/height_band.hpp"
#include "gui/view/map_canvas.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/place_view.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kDrawDrive = 1.0 / 24.0;  // s between drawings of what moves without a picture
constexpr double kSilent = 0.6;            // s; an older reading is not drawn as if it were live
constexpr double kRadians = 3.14159265358979323846 / 180.0;

/// From above: the floor about the robot as it sees it, or the map that it has learnt.
class MapPanel : public Panel {
 public:
  explicit MapPanel(const PanelContext& panel_context)
      : Panel(panel_context),
        strip_(new HeaderStrip(tr("Map"))),
        canvas_(new MapCanvas(panel_context.robot)),
        place_(new PlaceView(panel_context)),
        robot_button_(new QToolButton),
        place_button_(new QToolButton),
        switch_(new FloorSwitch(panel_context.ask_floor)),
        heights_(new QToolButton) {
    auto* controls = new QWidget;
    auto* row = new QHBoxLayout(controls);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(theme::kSpace);
    addViewSwitch(row);
    row->addWidget(robot_controls_ = new QWidget);
    row->addWidget(place_->controls());
    auto* own = new QHBoxLayout(robot_controls_);
    own->setContentsMargins(0, 0, 0, 0);
    own->setSpacing(theme::kSpace);
    own->addWidget(switch_);
    own->addWidget(heights_);
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
    pages_ = new QStackedLayout(this);
    pages_->addWidget(canvas_);
    pages_->addWidget(place_);
    canvas_->setObjectName("map_canvas");
    addAction(tr("About the robot, or the map that it has learnt"), {Qt::Key_V},
              [this] { choose(!placeShown()); });
    addMoves();
    addAction(tr("Improved or original method"), {Qt::Key_M}, [this] { switch_->toggleMethod(); });
    addAction(tr("Calibrate the camera's mounting"), {Qt::Key_C},
              [this] { switch_->toggleCalibration(); });
    addAction(tr("Pick out a height"), {Qt::Key_H}, [this] { heights_->toggle(); });
    actions_ += place_->menuActions();
    connect(place_, &PlaceView::wanted, this, [this] {
      choose(true);
      emit wanted();
    });
    showPlace(false);
  }

  void refreshPicture(double now) override {
    if (auto floor = context().state.floor.take(now)) canvas_->setFloor(std::move(floor));
    if (auto objects = context().state.objects.take(now)) canvas_->setObjects(std::move(objects));
    const DriveOverlay drive = overlay(now);
    place_->refresh(now, drive, judged_);
    if (now - driven_at_ < kDrawDrive || placeShown()) return;
    driven_at_ = now;
    canvas_->setDrive(drive);
    canvas_->update();
  }

  void refreshNumbers(double now) override {
    const auto names = context().state.names.get();
    const auto filtered = names.find("objects/filtered");
    const FeedState objects = context().state.objects.state(now);
    judged_ = filtered != names.end() && objects.ever && objects.topic == filtered->second;
    canvas_->setJudged(judged_);
    if (!chosen_ && !placeShown() && navigates()) showPlace(true);
    if (view_switch_->isHidden() && context().state.place.map.latest()) arrangeControls();
    switch_->show(context().state.floor_settings.get(), now);
    const FeedState state = context().state.floor.state(now);
    strip_->show(placeShown() ? poseState(now) : state);
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

  bool complete() const override {
    return placeShown() ? place_->canvas()->scene().pose != nullptr : canvas_->hasFloor();
  }
  void aimed(int key, Qt::KeyboardModifiers modifiers) override {
    if (placeShown()) place_->nudged(key, modifiers);
  }
  QWidget* titleStrip() override { return strip_; }
  QVector<QAction*> menuActions() override { return actions_; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    Panel::resizeEvent(event);
    placeBand();
  }

 private:
  /// Of the pose the newest alone counts: what a newer one replaced is no loss.
  FeedState poseState(double now) const {
    FeedState pose = context().state.place.pose.state(now);
    pose.drops = 0;
    return pose;
  }

  bool placeShown() const { return pages_->currentWidget() == place_; }

  /// A map is there and somebody who drives by it.
  bool navigates() const {
    return context().state.place.map.latest() && context().state.place.task.latest();
  }

  /// The operator's choice stands.
  void choose(bool place) {
    chosen_ = true;
    showPlace(place);
  }

  void showPlace(bool place) {
    pages_->setCurrentWidget(place ? static_cast<QWidget*>(place_) : canvas_);
    robot_controls_->setVisible(!place);
    place_->controls()->setVisible(place);
    robot_button_->setChecked(!place);
    place_button_->setChecked(place);
    arrangeControls();
  }

  /// Without a map there is nothing to switch to, and its room is wanted for other things.
  void arrangeControls() {
    const bool switchable = placeShown() || context().state.place.map.latest() != nullptr;
    view_switch_->setVisible(switchable);
    strip_->controlChanged(switchable);
  }

  void addViewSwitch(QHBoxLayout* row) {
    view_switch_ = new QWidget;
    auto* both = new QHBoxLayout(view_switch_);
    both->setContentsMargins(0, 0, 0, 0);
    both->setSpacing(0);
    const auto add = [&](QToolButton* button, const QString& text, const char* end, bool place) {
      button->setText(text);
      button->setCheckable(true);
      button->setProperty("segment", end);
      button->setFocusPolicy(Qt::NoFocus);
      button->setToolTip(tr("About the robot, or the map that it has learnt (V)"));
      connect(button, &QToolButton::clicked, this, [this, place] { choose(place); });
      both->addWidget(button);
    };
    add(robot_button_, tr("Robot"), "left", false);
    add(place_button_, tr("Map"), "right", true);
    row->addWidget(view_switch_);
  }

  void addMoves() {
    const auto both = [this](const QString& text, const QList<QKeySequence>& keys, auto act) {
      auto* action = addAction(text, keys, [this, act] {
        if (placeShown()) {
          act(place_->canvas());
        } else {
          act(canvas_);
        }
      });
      repeatWhileHeld(action);
    };
    both(tr("Fit the map"), {Qt::Key_F}, [](auto* canvas) { canvas->fit(); });
    both(tr("Zoom in"), {Qt::Key_Plus, Qt::Key_Equal}, [](auto* canvas) { canvas->zoomIn(); });
    both(tr("Zoom out"), {Qt::Key_Minus}, [](auto* canvas) { canvas->zoomOut(); });
    const auto move = [&](const QString& text, int key, QPoint by) {
      both(text, {QKeySequence(int(Qt::CTRL) + key)}, [by](auto* canvas) { canvas->pan(by); });
    };
    move(tr("Move the map left"), Qt::Key_Left, {60, 0});
    move(tr("Move the map right"), Qt::Key_Right, {-60, 0});
    move(tr("Move the map up"), Qt::Key_Up, {0, 60});
    move(tr("Move the map down"), Qt::Key_Down, {0, -60});
  }

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
  QAction* addAction(const QString& text, const QList<QKeySequence>& keys, Slot slot) {
    auto* action = new QAction(text, this);
    action->setShortcuts(keys);
    connect(action, &QAction::triggered, this, slot);
    actions_ << action;
    return action;
  }

  HeaderStrip* strip_;
  MapCanvas* canvas_;
  PlaceView* place_;
  QToolButton *robot_button_, *place_button_;
  QStackedLayout* pages_ = nullptr;
  QWidget *robot_controls_ = nullptr, *view_switch_ = nullptr;
  bool judged_ = false, chosen_ = false;
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
