// The 3D view by librviz, in a library of its own so that the console starts without rviz. The one
// place where ROS runs on the GUI thread, because librviz does so; it is made only while a master
// answers, and only when the panel is shown.

#include <rviz/display.h>
#include <rviz/display_group.h>
#include <rviz/properties/property.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QTimerEvent>
#include <QVBoxLayout>
#include <memory>

#include "gui/rviz/thinned_cloud.hpp"
#include "gui/rviz/volume_cloud.hpp"

namespace pilothouse::gui {

namespace {

class SceneView : public QWidget {
 public:
  explicit SceneView(const QString& frame)
      : robot_frame_(frame), panel_(new rviz::RenderPanel(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(panel_);
    manager_ = new rviz::VisualizationManager(panel_);
    panel_->initialize(manager_->getSceneManager(), manager_);
    manager_->initialize();
    manager_->setFixedFrame(frame);
    manager_->startUpdate();
    auto* options = manager_->getRootDisplayGroup()->subProp("Global Options");
    options->subProp("Background Color")->setValue(QColor(0x12, 0x15, 0x19));
    // It draws on the GUI thread, all the time, and without a graphics card slowly.
    options->subProp("Frame Rate")->setValue(15);
    connectAnew();
  }
  ~SceneView() override {
    manager_->stopUpdate();
    manager_->removeAllDisplays();
    delete manager_;
  }

  /// All that knows the master, made again: for a new master. A second RenderPanel in one process
  /// aborts inside Ogre, so the panel itself stays.
  void connectAnew() {
    manager_->removeAllDisplays();
    boxes_ = nullptr;
    volume_.reset();
    floor_.reset();
    obstacles_.reset();
    manager_->setFixedFrame(robot_frame_);
    floor_ = std::make_unique<ThinnedCloud>("floor_points", "console_scene/floor");
    obstacles_ = std::make_unique<ThinnedCloud>("obstacle_points", "console_scene/obstacles");
    auto* grid = manager_->createDisplay("rviz/Grid", "grid", true);
    grid->subProp("Color")->setValue(QColor(60, 68, 80));
    addCloud("floor", floor_->topic(), QColor(0x3f, 0x86, 0xb0));
    addCloud("obstacles", obstacles_->topic(), QColor(0xe0, 0x62, 0x14));
    auto* robot = manager_->createDisplay("rviz/Axes", "robot", true);
    robot->subProp("Reference Frame")->setValue(robot_frame_);
    robot->subProp("Length")->setValue(0.5);
    robot->subProp("Radius")->setValue(0.03);
  }

  /// The space that was learnt, in boxes. It stays in its own frame, and the view goes along with
  /// the robot. @return whether it is drawn: something has come.
  bool showVolume(bool wanted) {
    if (!wanted) {
      if (boxes_) delete boxes_;
      boxes_ = nullptr;
      if (volume_) manager_->setFixedFrame(robot_frame_);
      volume_.reset();
      return false;
    }
    if (!volume_) volume_ = std::make_unique<VolumeCloud>();
    const VolumeCloud::State state = volume_->state();
    if (state.frame.empty()) return false;
    const QString frame = QString::fromStdString(state.frame);
    if (manager_->getFixedFrame() != frame) manager_->setFixedFrame(frame);
    if (!boxes_) {
      boxes_ = addCloud("volume", volume_->topic(), {});
      boxes_->subProp("Style")->setValue("Boxes");
      boxes_->subProp("Color Transformer")->setValue("RGB8");
    }
    if (boxes_->subProp("Size (m)")->getValue().toFloat() != state.edge) {
      boxes_->subProp("Size (m)")->setValue(state.edge);
    }
    return true;
  }

  /// The view from behind and above. librviz shows nothing when it is set before the first frame.
  void lookAtRobot() {
    auto* view = manager_->getViewManager()->getCurrent();
    if (!view) return;
    view->subProp("Target Frame")->setValue(robot_frame_);
    view->subProp("Distance")->setValue(4.5);
    view->subProp("Pitch")->setValue(0.7);
    view->subProp("Yaw")->setValue(3.1416);
    auto* focus = view->subProp("Focal Point");
    if (focus) focus->subProp("X")->setValue(1.5);
  }

 protected:
  void showEvent(QShowEvent*) override { startTimer(800); }
  void timerEvent(QTimerEvent* event) override {
    killTimer(event->timerId());
    lookAtRobot();
  }

 private:
  rviz::Display* addCloud(const QString& name, const std::string& topic, const QColor& colour) {
    auto* cloud = manager_->createDisplay("rviz/PointCloud2", name, true);
    cloud->subProp("Topic")->setValue(QString::fromStdString(topic));
    cloud->subProp("Queue Size")->setValue(1);
    cloud->subProp("Style")->setValue("Points");
    cloud->subProp("Size (Pixels)")->setValue(3);
    cloud->subProp("Color Transformer")->setValue("FlatColor");
    if (colour.isValid()) cloud->subProp("Color")->setValue(colour);
    cloud->subProp("Selectable")->setValue(false);
    return cloud;
  }

  const QString robot_frame_;

  std::unique_ptr<ThinnedCloud> floor_, obstacles_;
  std::unique_ptr<VolumeCloud> volume_;  ///< while it is wanted
  rviz::Display* boxes_ = nullptr;
  rviz::RenderPanel* panel_;
  rviz::VisualizationManager* manager_;
};

}  // namespace

}  // namespace pilothouse::gui

/// Made by the console through QLibrary. @param frame the fixed frame. The caller owns the widget.
extern "C" Q_DECL_EXPORT QWidget* pilothouseMakeScene(const char* frame) {
  return new pilothouse::gui::SceneView(QString::fromUtf8(frame));
}

/// @param scene made by pilothouseMakeScene; the master is another than before.
extern "C" Q_DECL_EXPORT void pilothouseConnectSceneAnew(QWidget* scene) {
  static_cast<pilothouse::gui::SceneView*>(scene)->connectAnew();
}

/// @return whether the space is drawn; it is not while nothing has come.
extern "C" Q_DECL_EXPORT bool pilothouseShowVolume(QWidget* scene, bool wanted) {
  return static_cast<pilothouse::gui::SceneView*>(scene)->showVolume(wanted);
}
