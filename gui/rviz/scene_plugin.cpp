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

namespace pilothouse::gui {

namespace {

class SceneView : public QWidget {
 public:
  explicit SceneView(const QString& frame) : panel_(new rviz::RenderPanel(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(panel_);
    manager_ = new rviz::VisualizationManager(panel_);
    panel_->initialize(manager_->getSceneManager(), manager_);
    manager_->initialize();
    manager_->setFixedFrame(frame);
    manager_->startUpdate();
    manager_->getRootDisplayGroup()
        ->subProp("Global Options")
        ->subProp("Background Color")
        ->setValue(QColor(0x12, 0x15, 0x19));
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
    floor_.reset();
    obstacles_.reset();
    floor_ = std::make_unique<ThinnedCloud>("floor_points", "console_scene/floor");
    obstacles_ = std::make_unique<ThinnedCloud>("obstacle_points", "console_scene/obstacles");
    auto* grid = manager_->createDisplay("rviz/Grid", "grid", true);
    grid->subProp("Color")->setValue(QColor(60, 68, 80));
    addCloud("floor", floor_->topic(), QColor(0x3f, 0x86, 0xb0));
    addCloud("obstacles", obstacles_->topic(), QColor(0xe0, 0x62, 0x14));
  }

  /// The view from behind and above. librviz shows nothing when it is set before the first frame.
  void lookAtRobot() {
    auto* view = manager_->getViewManager()->getCurrent();
    if (!view) return;
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
  void addCloud(const QString& name, const std::string& topic, const QColor& colour) {
    auto* cloud = manager_->createDisplay("rviz/PointCloud2", name, true);
    cloud->subProp("Topic")->setValue(QString::fromStdString(topic));
    cloud->subProp("Queue Size")->setValue(1);
    cloud->subProp("Style")->setValue("Points");
    cloud->subProp("Size (Pixels)")->setValue(3);
    cloud->subProp("Color Transformer")->setValue("FlatColor");
    cloud->subProp("Color")->setValue(colour);
    cloud->subProp("Selectable")->setValue(false);
  }

  std::unique_ptr<ThinnedCloud> floor_, obstacles_;
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
