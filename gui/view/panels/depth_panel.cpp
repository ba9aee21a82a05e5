#include <QPainter>
#include <QVBoxLayout>

#include "gui/view/header_strip.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/picture_canvas.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

/// The depth picture in false colour with its legend, and metres under the cursor.
class DepthPanel : public Panel {
 public:
  explicit DepthPanel(const PanelContext& panel_context)
      : Panel(panel_context), strip_(new HeaderStrip(tr("Depth"))), canvas_(new PictureCanvas) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(canvas_);
    canvas_->setObjectName("depth_canvas");
    canvas_->setReadout([this](QPoint pixel) { return readout(pixel); });
    canvas_->setLegend(PictureCanvas::kLegendWidth,
                       [this](QPainter& p, const QRectF& area) { legend(p, area); });
  }

  void refreshPicture(double now) override {
    if (auto picture = context().state.depth.take(now)) {
      picture_ = std::move(picture);
      canvas_->setPicture(picture_->image);
    }
  }

  void refreshNumbers(double now) override {
    const FeedState state = context().state.depth.state(now);
    strip_->show(state);
    canvas_->setState(state, waitingFor(context().state, tr("Depth"),
                                        {"camera/depth/image_rect", "camera/depth/points"},
                                        tr("Start a camera, or replay a recording with\n"
                                           "scripts/run --bag FILE"),
                                        state));
  }

  bool complete() const override { return picture_ != nullptr; }
  QWidget* titleStrip() override { return strip_; }

 private:
  QString readout(QPoint pixel) const {
    if (!picture_) return {};
    const float metres = picture_->at(pixel.x(), pixel.y());
    const QString place = tr("pixel %1, %2").arg(pixel.x()).arg(pixel.y());
    return metres > 0.0F ? tr("%1 m   %2").arg(double(metres), 0, 'f', 3).arg(place)
                         : tr("no measurement   %1").arg(place);
  }

  void legend(QPainter& painter, const QRectF& area) {
    if (!picture_) return;
    const DepthSpan span = picture_->span;
    const QRectF bar(area.left() + 10, area.top() + 22, 10, std::max(10.0, area.height() - 34));
    QImage colours(1, 256, QImage::Format_RGB32);
    for (int i = 0; i < 256; ++i) {
      const float metres = span.far_m + (span.near_m - span.far_m) * static_cast<float>(i) / 255.0F;
      colours.setPixel(0, i, ramp_.colour(std::max(metres, 1e-6F), span));
    }
    painter.drawImage(bar, colours);
    painter.setFont(theme::smallFont());
    painter.setPen(theme::kMuted);
    painter.drawText(QRectF(bar.left(), area.top(), 40, 18), Qt::AlignLeft | Qt::AlignVCenter,
                     tr("m"));
    const double range = double(span.far_m) - double(span.near_m);
    const double step = range > 6.0 ? 2.0 : range > 3.0 ? 1.0 : 0.5;
    for (double metres = double(span.near_m); metres < double(span.far_m) + 1e-6; metres += step) {
      const double y = bar.bottom() - (metres - double(span.near_m)) / range * bar.height();
      painter.drawLine(QPointF(bar.right() + 2, y), QPointF(bar.right() + 5, y));
      painter.drawText(QRectF(bar.right() + 8, y - 9, 30, 18), Qt::AlignLeft | Qt::AlignVCenter,
                       QString::number(metres, 'f', step < 1.0 ? 1 : 0) +
                           (metres + step > double(span.far_m) + 1e-6 ? "+" : ""));
    }
  }

  HeaderStrip* strip_;
  PictureCanvas* canvas_;
  DepthRamp ramp_;
  std::shared_ptr<const DepthPicture> picture_;
};

const PanelRegistration kRegistration({"depth", QObject::tr("Depth"), PanelPlace::kPicture, 10,
                                       true,
                                       [](const PanelContext& c) { return new DepthPanel(c); },
                                       nullptr});

}  // namespace

}  // namespace pilothouse::gui
