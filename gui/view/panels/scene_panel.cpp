#include <QAction>
#include <QCoreApplication>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLibrary>
#include <QPainter>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/view/header_strip.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

QString pluginFile() {
  return QFileInfo(QCoreApplication::applicationDirPath() + "/../libpilothouse_rviz_panel.so")
      .absoluteFilePath();
}

QString hindrance() {
  if (!QFileInfo(pluginFile()).isFile()) return QObject::tr("built without rviz");
  if (QGuiApplication::platformName() != "xcb") return QObject::tr("rviz needs X11");
  return {};
}

/// The floor and obstacle points and the space that was learnt in 3D, drawn by librviz, which is
/// loaded when the panel is first shown and a master answers.
class ScenePanel : public Panel {
 public:
  explicit ScenePanel(const PanelContext& panel_context)
      : Panel(panel_context),
        library_(pluginFile()),
        layout_(new QVBoxLayout(this)),
        strip_(new HeaderStrip(tr("3D view"))),
        volume_(new QToolButton) {
    strip_->withoutFigures();
    volume_->setText(tr("Volume"));
    volume_->setObjectName("scene_volume");
    volume_->setCheckable(true);
    volume_->setChecked(true);
    volume_->setFont(theme::smallFont());
    volume_->setProperty("segment", "alone");
    volume_->setFixedHeight(24);
    volume_->setFocusPolicy(Qt::NoFocus);
    strip_->addControl(volume_);
    connect(volume_, &QToolButton::toggled, this, [this] { showVolume(); });
    toggle_ = new QAction(tr("The space that was learnt"), this);
    toggle_->setShortcut(Qt::Key_B);
    connect(toggle_, &QAction::triggered, volume_, &QToolButton::toggle);
    layout_->setContentsMargins(0, 0, 0, 0);
    setMinimumSize(160, 100);
  }
  ~ScenePanel() override { delete scene_; }

  void refreshPicture(double) override {}

  void refreshNumbers(double) override {
    const LinkStatus link = context().state.link.get();
    const bool connected = link.phase == LinkPhase::kConnected;
    if (scene_) {
      // librviz does not subscribe anew at another master by itself.
      if (connected && link.since != made_since_) {
        using ConnectAnew = void (*)(QWidget*);
        const auto anew = library_.resolve("pilothouseConnectSceneAnew");
        if (anew) reinterpret_cast<ConnectAnew>(anew)(scene_);
        made_since_ = link.since;
      }
      scene_->setVisible(connected);
    } else if (connected && isVisible() && fault_.isEmpty()) {
      make(link);
    }
    showVolume();
    update();
  }

  QWidget* titleStrip() override { return strip_; }
  QVector<QAction*> menuActions() override { return {toggle_}; }
  bool complete() const override { return scene_ != nullptr || !fault_.isEmpty(); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.fillRect(rect(), theme::kPanel);
    if (!fault_.isEmpty()) {
      paintEmpty(painter, rect(), {tr("rviz cannot be loaded"), fault_});
    } else if (!scene_ || !scene_->isVisible()) {
      paintEmpty(painter, rect(),
                 waitingFor(context().state, tr("The 3D view"), {"floor_points"}, {}, {}));
    }
  }

 private:
  /// Nothing is asked for while nobody sees it.
  void showVolume() {
    bool drawn = false;
    if (scene_) {
      using Show = bool (*)(QWidget*, bool);
      const auto show = reinterpret_cast<Show>(library_.resolve("pilothouseShowVolume"));
      drawn = show && show(scene_, volume_->isChecked() && scene_->isVisible());
    }
    volume_->setToolTip(
        drawn || !volume_->isChecked()
            ? tr("The space that was learnt, in cubes: dark on the floor, bright 1.2 m above (B)")
            : tr("Nothing has come on %1 yet (B). It is learnt with volume:=true:\n"
                 "roslaunch pilothouse robot.launch ... volume:=true")
                  .arg(QString::fromStdString(shownTopic(context().state, "volume_points"))));
  }

  void make(const LinkStatus& link) {
    using Make = QWidget* (*)(const char*);
    const auto make_scene = reinterpret_cast<Make>(library_.resolve("pilothouseMakeScene"));
    if (!make_scene) {
      fault_ = library_.errorString();
      return;
    }
    const auto floor = context().state.floor.latest();
    scene_ = make_scene(floor && !floor->frame.empty() ? floor->frame.c_str() : "base_link");
    made_since_ = link.since;
    layout_->addWidget(scene_);
  }

  QLibrary library_;
  QVBoxLayout* layout_;
  HeaderStrip* strip_;
  QToolButton* volume_;
  QAction* toggle_ = nullptr;
  QWidget* scene_ = nullptr;
  double made_since_ = 0.0;
  QString fault_;
};

const PanelRegistration kRegistration({"scene", QObject::tr("3D view"), PanelPlace::kMain, 20,
                                       false,
                                       [](const PanelContext& c) { return new ScenePanel(c); },
                                       hindrance});

}  // namespace

}  // namespace pilothouse::gui
