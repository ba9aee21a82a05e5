#include "gui/view/place_view.hpp"

#include <QAction>
#include <QApplication>
#include <QHBoxLayout>
#include <QHideEvent>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/model/helm.hpp"
#include "gui/view/map_files.hpp"
#include "gui/view/route_card.hpp"
#include "gui/view/route_tool.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kDraw = 1.0 / 24.0;  // s between drawings
constexpr double kSilent = 1.0;       // s; what is older is not drawn as if it were seen now

std::string plainFrame(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

// What is in another frame than the map would be drawn at a wrong place: it is not drawn, but told.
void keepToTheFrame(PlaceScene& scene) {
  if (!scene.map) return;
  const std::string frame = plainFrame(scene.map->frame);
  const auto keep = [&](auto& what, const char* name) {
    const std::string its = what ? plainFrame(what->frame) : std::string();
    if (its.empty() || frame.empty() || its == frame) return;
    scene.refused = std::string(name) + " in frame " + its + ", expected " + frame;
    what = nullptr;
  };
  keep(scene.path, "the way is");
  keep(scene.standing, "the things that stay are");
  keep(scene.pose, "the pose is");
}
}  // namespace

PlaceView::PlaceView(const PanelContext& context, QWidget* parent)
    : QWidget(parent),
      context_(context),
      canvas_(new PlaceCanvas(context.robot)),
      controls_(new QWidget),
      goal_(AimTool::For::kGoal, context.state.place, context.ask_place, context.robot.outline()),
      pose_(AimTool::For::kPose, context.state.place, context.ask_place, context.robot.outline()),
      route_(std::make_unique<RouteTool>(context.state.place, context.ask_place,
                                         context.robot.outline())),
      card_(new RouteCard(*route_, context.state.place, canvas_)),
      layers_(new QMenu(this)) {
  canvas_->setObjectName("place_canvas");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(canvas_);
  auto* row = new QHBoxLayout(controls_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  addTools();
  addLayers();
  addFiles();
  addToolKeys();
  card_->hide();
  connect(route_.get(), &RouteTool::changed, canvas_, QOverload<>::of(&QWidget::update));
  connect(canvas_, &PlaceCanvas::takenBack, this, [this] { key(ToolKey::kTakeBack); });
  connect(canvas_, &PlaceCanvas::followChanged, this,
          [this] { follow_action_->setChecked(canvas_->follows()); });
}

PlaceView::~PlaceView() {
  canvas_->setTool(nullptr);
  if (context_.helm) context_.helm->setArrowsAim(false);
  delete card_;  // before the route that it shows
}

QAction* PlaceView::addAction(const QString& text, const QList<QKeySequence>& keys,
                              const std::function<void()>& act) {
  auto* action = new QAction(text, this);
  action->setShortcuts(keys);
  connect(action, &QAction::triggered, this, act);
  actions_ << action;
  return action;
}

QToolButton* PlaceView::addButton(QAction* action, const QString& text) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setCheckable(true);
  button->setToolTip(QString("%1 (%2)").arg(action->text(),
                                            action->shortcut().toString(QKeySequence::NativeText)));
  button->setProperty("segment", "alone");
  button->setFocusPolicy(Qt::NoFocus);
  connect(button, &QToolButton::clicked, action, &QAction::trigger);
  connect(action, &QAction::toggled, button, &QToolButton::setChecked);
  controls_->layout()->addWidget(button);
  return button;
}

void PlaceView::addTools() {
  const auto tool = [this](const QString& text, int key, MapTool* what) {
    auto* action = addAction(text, {key}, [this, what] { take(tool_ == what ? nullptr : what); });
    action->setCheckable(true);
    action->setEnabled(static_cast<bool>(context_.ask_place));
    return action;
  };
  goal_action_ = tool(tr("Aim at a goal"), Qt::Key_G, &goal_);
  route_action_ = tool(tr("Edit a route"), Qt::Key_R, route_.get());
  pose_action_ = tool(tr("Say where the robot is"), Qt::Key_I, &pose_);
  follow_action_ = addAction(tr("Follow the robot"), {Qt::Key_Home},
                             [this] { canvas_->setFollow(follow_action_->isChecked()); });
  follow_action_->setCheckable(true);
  addButton(goal_action_, tr("Goal"));
  addButton(route_action_, tr("Route"));
  addButton(pose_action_, tr("Pose"));
}

void PlaceView::addLayers() {
  const struct {
    PlaceLayer layer;
    QString name;
  } all[] = {{PlaceLayer::kMap, tr("Map's cells")},
             {PlaceLayer::kFloor, tr("Floor as seen now")},
             {PlaceLayer::kStanding, tr("Things that stay")},
             {PlaceLayer::kObjects, tr("Things seen now")},
             {PlaceLayer::kTrail, tr("Trail")},
             {PlaceLayer::kPath, tr("Way and goal")},
             {PlaceLayer::kRobot, tr("Robot")}};
  auto* open = addAction(tr("Layers; save, load, clear"), {Qt::Key_L}, [this] {
    layers_->popup(canvas_->mapToGlobal(QPoint(theme::kSpace, theme::kSpace)));
  });
  int number = 0;
  for (const auto& one : all) {
    auto* action = addAction(tr("Layer: %1").arg(one.name), {Qt::Key_1 + number++}, [] {});
    action->setCheckable(true);
    action->setChecked(true);
    connect(action, &QAction::toggled, this,
            [this, layer = one.layer](bool on) { canvas_->setLayer(layer, on); });
    layers_->addAction(action);
  }
  auto* button = addButton(open, tr("More"));
  button->setCheckable(false);
}

void PlaceView::addFiles() {
  files_ = new MapFiles(context_.ask_place, this);
  layers_->addSeparator();
  const struct {
    QString name, key;
    void (MapFiles::*act)();
  } all[] = {{tr("Save the map ..."), "Ctrl+Shift+S", &MapFiles::save},
             {tr("Load a map ..."), "Ctrl+Shift+O", &MapFiles::load},
             {tr("Clear the map ..."), "Ctrl+Shift+Del", &MapFiles::clear}};
  for (const auto& one : all) {
    auto* action =
        addAction(one.name, {QKeySequence(one.key)}, [this, act = one.act] { (files_->*act)(); });
    action->setEnabled(static_cast<bool>(context_.ask_place));
    layers_->addAction(action);
  }
}

void PlaceView::addKey(const QString& text, const QList<QKeySequence>& keys, ToolKey key) {
  tool_keys_ << addAction(text, keys, [this, key] { this->key(key); });
  tool_keys_.back()->setEnabled(false);
  if (key == ToolKey::kTurnLeft || key == ToolKey::kTurnRight) repeatWhileHeld(tool_keys_.back());
}

void PlaceView::addToolKeys() {
  addKey(tr("Send it"), {Qt::Key_Return, Qt::Key_Enter}, ToolKey::kEnter);
  addKey(tr("Take it back"), {Qt::Key_Backspace}, ToolKey::kTakeBack);
  addKey(tr("Turn left"), {Qt::Key_Comma}, ToolKey::kTurnLeft);
  addKey(tr("Turn right"), {Qt::Key_Period}, ToolKey::kTurnRight);
  addKey(tr("Any heading"), {Qt::Key_N}, ToolKey::kAnyHeading);
  addKey(tr("Take the nearest place that can be reached"), {Qt::Key_T}, ToolKey::kNearest);
  addKey(tr("Point before, or surer of the pose"), {Qt::Key_BracketLeft}, ToolKey::kLess);
  addKey(tr("Next point, or less sure of the pose"), {Qt::Key_BracketRight}, ToolKey::kMore);
  addKey(tr("Insert a point at the cross"), {Qt::Key_Insert}, ToolKey::kInsert);
  addKey(tr("Remove the point"), {Qt::Key_Delete}, ToolKey::kRemove);
  addKey(tr("Point earlier"), {Qt::Key_PageUp}, ToolKey::kEarlier);
  addKey(tr("Point later"), {Qt::Key_PageDown}, ToolKey::kLater);
  addKey(tr("Loop"), {Qt::Key_O}, ToolKey::kLoop);
  addKey(tr("Undo"), {QKeySequence("Ctrl+Z")}, ToolKey::kUndo);
  addKey(tr("Redo"), {QKeySequence("Ctrl+Shift+Z")}, ToolKey::kRedo);
  addKey(tr("Save the route"), {QKeySequence("Ctrl+S")}, ToolKey::kSave);
  addKey(tr("Load a route"), {QKeySequence("Ctrl+O")}, ToolKey::kLoad);
}

void PlaceView::take(MapTool* tool) {
  if (tool) emit wanted();
  if (tool_ && tool_ != tool) tool_->end();
  tool_ = tool;
  canvas_->setTool(tool);
  if (tool) {
    const auto pose = context_.state.place.pose.latest();
    const QPointF robot = pose ? canvas_->view().toPixel(pose->pose.x, pose->pose.y) : QPointF();
    // Beside the robot where it is in sight: that is where the operator looks.
    const bool seen = pose && canvas_->rect().contains(robot.toPoint());
    tool->begin(seen ? pose->pose.position() : canvas_->middle());
    canvas_->setFocus();
  }
  goal_action_->setChecked(tool == &goal_);
  route_action_->setChecked(tool == route_.get());
  pose_action_->setChecked(tool == &pose_);
  for (auto* action : tool_keys_) action->setEnabled(tool != nullptr);
  card_->setVisible(tool == route_.get());
  placeCard();
  if (context_.helm) context_.helm->setArrowsAim(tool != nullptr);
}

// Enter in a field ends the field, it sends nothing; what is not about files is the field's.
void PlaceView::key(ToolKey key) {
  QWidget* focus = QApplication::focusWidget();
  const bool in_field = focus && card_->isAncestorOf(focus);
  if (in_field && key == ToolKey::kEnter) return canvas_->setFocus();
  const bool of_files = key == ToolKey::kSave || key == ToolKey::kLoad;
  if (!tool_ || (in_field && !of_files)) return;
  if (key == ToolKey::kSave && tool_ == route_.get()) return card_->save();
  tool_->key(key);
  canvas_->update();
}

void PlaceView::nudged(int key, Qt::KeyboardModifiers modifiers) {
  if (!tool_) return;
  const bool fine = modifiers & Qt::ShiftModifier;
  switch (key) {
    case Qt::Key_Left:
      return canvas_->nudge(-1, 0, fine);
    case Qt::Key_Right:
      return canvas_->nudge(1, 0, fine);
    case Qt::Key_Up:
      return canvas_->nudge(0, 1, fine);
    case Qt::Key_Down:
      return canvas_->nudge(0, -1, fine);
    default:
      return take(nullptr);
  }
}

// Without being seen no tool stays in hand; a window that is minimised keeps its own.
void PlaceView::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  if (!event->spontaneous()) take(nullptr);
}

PlaceScene PlaceView::sceneAt(double now, const DriveOverlay& drive, bool judged) {
  const ConsoleState& state = context_.state;
  const auto recent = [&](const auto& feed) {
    const FeedState health = feed.state(now);
    return health.ever && health.age_s < kSilent ? feed.latest() : nullptr;
  };
  PlaceScene scene;
  scene.map = state.place.map.latest();
  scene.standing = state.place.standing.latest();
  scene.pose = state.place.pose.latest();
  scene.floor = recent(state.floor);
  scene.objects = recent(state.objects);
  scene.path = state.place.path.get();
  const auto task = state.place.task.latest();
  const bool driven = task && task->behaviour != "hand" &&
                      (task->phase == TaskPhase::kRunning || task->phase == TaskPhase::kPaused);
  if (driven) scene.under_way = state.place.navigation.latest();
  scene.drive = drive;
  scene.judged = judged;
  scene.pose_state = state.place.pose.state(now);
  const FeedState map = state.place.map.state(now);
  scene.place = state.place.place;
  if (!map.rejection.empty()) scene.refused = "map rejected: " + map.rejection;
  keepToTheFrame(scene);
  scene.words = waitingFor(state, tr("The map"), {"map_cells", "pose"},
                           tr("The mapper and the pose tracker make them:\n"
                              "roslaunch pilothouse robot.launch pose:=true goals:=true"),
                           map);
  return scene;
}

void PlaceView::refresh(double now, const DriveOverlay& drive, bool judged) {
  const bool asked = tool_ && tool_->refresh(now);
  if (tool_ != route_.get()) route_->refresh(now);  // what it loads, what is under way
  if (!isVisible() || (!asked && now - drawn_at_ < kDraw)) return;
  drawn_at_ = now;
  canvas_->show(sceneAt(now, drive, judged));
}

void PlaceView::placeCard() {
  card_->adjustSize();
  card_->move(canvas_->width() - card_->width() - theme::kSpace,
              static_cast<int>(kWordsHeight) + 2 * theme::kSpace);
}

void PlaceView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  placeCard();
}

}  // namespace pilothouse::gui
