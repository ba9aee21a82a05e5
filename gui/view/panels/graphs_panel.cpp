#include <QAction>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "gui/view/header_strip.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/plot.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kRedraw = 1.0 / 24.0;  // s
// Apart for every kind of colour blindness, by lightness too; widths tell the main ones.
const QColor kWanted(0x9f, 0xb3, 0xc8), kLimited(0xff, 0xc1, 0x4d), kMeasured(0x5a, 0xb4, 0xff);
const QColor kLimit(0xff, 0x7b, 0x6e), kBeside(0xf0, 0x9a, 0x28);
const QColor kOthers[] = {{0x56, 0xd3, 0x9b}, {0xc3, 0x8f, 0xf0}, {0x8f, 0xd6, 0xe8},
                          {0xd8, 0xd2, 0x8a}, {0xe6, 0x9c, 0xb8}, {0x9a, 0xa8, 0x6a},
                          {0xb8, 0x86, 0x5b}, {0x7f, 0x8f, 0xd8}};
constexpr std::size_t kOtherColours = sizeof kOthers / sizeof kOthers[0];

/// Speeds and free ways over time, above each other, with one time axis and one cursor.
class GraphsPanel : public Panel {
 public:
  explicit GraphsPanel(const PanelContext& panel_context)
      : Panel(panel_context),
        strip_(new HeaderStrip(tr("Graphs"))),
        speed_(new Plot(time_, tr("Speed"), tr("m/s"), 0.2)),
        distance_(new Plot(time_, tr("Free way"), tr("m"), 1.0)),
        pause_(new QToolButton) {
    strip_->withoutFigures();
    pause_->setText(tr("Pause"));
    pause_->setCheckable(true);
    pause_->setProperty("segment", "alone");
    pause_->setFocusPolicy(Qt::NoFocus);
    pause_->setToolTip(tr("Hold the graphs still; what arrives is kept (P)"));
    strip_->addControl(pause_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* split = new QSplitter(Qt::Vertical);
    split->setHandleWidth(3);
    split->setChildrenCollapsible(false);
    split->addWidget(speed_);
    split->addWidget(distance_);
    split->setStretchFactor(0, 11);
    split->setStretchFactor(1, 10);
    layout->addWidget(split);
    speed_->setObjectName("speed_plot");
    distance_->setObjectName("distance_plot");
    speed_->withTimeAxis(false);
    speed_->withRules();
    for (auto* plot : {speed_, distance_}) {
      connect(plot, &Plot::changed, this, [this] { bringUpToDate(); });
    }
    auto* action = new QAction(tr("Pause the graphs"), this);
    action->setShortcut(Qt::Key_P);
    connect(action, &QAction::triggered, pause_, &QToolButton::click);
    connect(pause_, &QToolButton::clicked, this, [this](bool held) {
      time_.held = held ? std::make_optional(time_.now) : std::nullopt;
      bringUpToDate();
    });
    actions_ << action;
    makeSeries();
  }

  void refreshPicture(double now) override {
    if (now - drawn_at_ < kRedraw || !isVisible()) return;
    drawn_at_ = now;
    time_.now = now;
    bringUpToDate();
  }

  void refreshNumbers(double now) override { now_known_ = now; }

  // Where nothing drives, e.g. while a bag is watched, there is nothing to wait for.
  bool complete() const override {
    const auto names = context().state.names.get();
    const auto found = names.find("speed_limit");
    if (found == names.end()) return true;
    return context().state.advertised.get().count(found->second) == 0 ||
           context().state.limit.state(now_known_).ever;
  }
  QWidget* titleStrip() override { return strip_; }
  QVector<QAction*> menuActions() override { return actions_; }

 private:
  void makeSeries() {
    auto& limit = speed_->seriesOf(tr("limit"), kLimit, 1.4);
    limit.style = Qt::DashLine;
    limit.scales = false;  // far from anything it is high above all speeds
    speed_->seriesOf(tr("wanted"), kWanted, 1.4);
    speed_->seriesOf(tr("limited"), kLimited, 2.2);
    speed_->seriesOf(tr("measured"), kMeasured, 2.2);
    distance_->seriesOf(tr("in the way"), kLimit, 2.2);
    distance_->seriesOf(tr("beside"), kBeside, 1.8).style = Qt::DashLine;
    distance_->setLevels(
        {{tr("stop distance"), context().robot.avoidance.stop_distance, QColor(0xff, 0x7b, 0x6e)}});
  }

  void take(Plot* plot, Series& series, const Trace& trace, double scale = 1.0) {
    trace.curve(time_.begin(), time_.end(), plot->columns(), series.points);
    if (scale != 1.0) {
      for (auto& point : series.points) point.value = std::abs(point.value) * scale;
    }
    const auto scaled = [&](double value) {
      return scale != 1.0 ? std::abs(value) * scale : value;
    };
    series.newest = scaled(trace.at(time_.end()));
    series.under_cursor = time_.cursor ? scaled(trace.at(*time_.cursor)) : kUnknown;
  }

  void bringUpToDate() {
    const double radius = context().robot.drive.wheel_radius;
    context().state.telemetry.read([&](const Telemetry::Curves& curves) {
      take(speed_, speed_->seriesOf(tr("limit"), kLimit), curves.limit);
      take(speed_, speed_->seriesOf(tr("wanted"), kWanted), curves.wanted);
      take(speed_, speed_->seriesOf(tr("limited"), kLimited), curves.limited);
      take(speed_, speed_->seriesOf(tr("measured"), kMeasured), curves.measured);
      std::size_t colour = 0;
      for (const auto& [name, trace] : curves.wheels) {
        auto& series = speed_->seriesOf(QString::fromStdString(name).replace('_', ' '),
                                        kOthers[colour++ % kOtherColours], 1.0);
        take(speed_, series, trace, radius);
      }
      take(distance_, distance_->seriesOf(tr("in the way"), kLimit), curves.obstacle);
      take(distance_, distance_->seriesOf(tr("beside"), kBeside), curves.potential);
      colour = 0;
      for (const auto& [name, trace] : curves.ranges) {
        auto& series = distance_->seriesOf(tr("%1 ranger").arg(QString::fromStdString(name)),
                                           kOthers[colour++ % kOtherColours], 1.2);
        take(distance_, series, trace);
      }
      speed_->setRules(std::vector<RuleStretch>(curves.rules.begin(), curves.rules.end()));
    });
    pause_->setChecked(time_.held.has_value());
    speed_->update();
    distance_->update();
  }

  GraphTime time_;
  HeaderStrip* strip_;
  Plot* speed_;
  Plot* distance_;
  QToolButton* pause_;
  QVector<QAction*> actions_;
  double drawn_at_ = -1e9, now_known_ = 0.0;
};

const PanelRegistration kRegistration({"graphs", QObject::tr("Graphs"), PanelPlace::kGraph, 40,
                                       true,
                                       [](const PanelContext& c) { return new GraphsPanel(c); },
                                       nullptr});

}  // namespace

}  // namespace pilothouse::gui
