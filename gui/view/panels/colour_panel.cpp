#include <QVBoxLayout>

#include "gui/view/header_strip.hpp"
#include "gui/view/panel_registry.hpp"
#include "gui/view/picture_canvas.hpp"

namespace pilothouse::gui {

namespace {

/// The colour picture.
class ColourPanel : public Panel {
 public:
  explicit ColourPanel(const PanelContext& panel_context)
      : Panel(panel_context), strip_(new HeaderStrip(tr("Colour"))), canvas_(new PictureCanvas) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(canvas_);
    canvas_->setObjectName("colour_canvas");
    // As wide as the depth picture's, so that the two lie exactly below each other.
    canvas_->setLegend(PictureCanvas::kLegendWidth, nullptr);
    canvas_->setReadout(
        [](QPoint pixel) { return tr("pixel %1, %2").arg(pixel.x()).arg(pixel.y()); });
  }

  void refreshPicture(double now) override {
    if (const auto picture = context().state.colour.take(now)) canvas_->setPicture(picture->image);
  }

  void refreshNumbers(double now) override {
    const FeedState state = context().state.colour.state(now);
    strip_->show(state);
    canvas_->setState(
        state, waitingFor(context().state, tr("Colour"),
                          {"camera/rgb/image_rect_color", "camera/rgb/image_rect_color/compressed"},
                          tr("A depth camera alone is enough for the map; the colour picture helps "
                             "you to recognise the place."),
                          state));
  }

  bool complete() const override { return canvas_->hasPicture(); }
  QWidget* titleStrip() override { return strip_; }

 private:
  HeaderStrip* strip_;
  PictureCanvas* canvas_;
};

const PanelRegistration kRegistration({"colour", QObject::tr("Colour"), PanelPlace::kPicture, 20,
                                       true,
                                       [](const PanelContext& c) { return new ColourPanel(c); },
                                       nullptr});

}  // namespace

}  // namespace pilothouse::gui
