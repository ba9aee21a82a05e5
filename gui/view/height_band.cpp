#include "gui/view/height_band.hpp"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <algorithm>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

QDoubleSpinBox* heightBox(double value) {
  auto* box = new QDoubleSpinBox;
  box->setRange(-1.0, 3.0);
  box->setDecimals(2);
  box->setSingleStep(0.05);
  box->setSuffix(QObject::tr(" m"));
  box->setFixedSize(64, 24);
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);  // wheel and arrow keys step
  box->setAlignment(Qt::AlignHCenter);
  box->setKeyboardTracking(false);  // half a number is no height
  box->setValue(value);
  box->setFocusPolicy(Qt::ClickFocus);
  QObject::connect(box, &QDoubleSpinBox::editingFinished, box, &QWidget::clearFocus);
  return box;
}

}  // namespace

HeightBandBox::HeightBandBox(QWidget* parent)
    : QWidget(parent), low_(heightBox(0.30)), high_(heightBox(0.60)) {
  setObjectName("height_band");
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 5, 8, 5);
  layout->setSpacing(6);
  const auto word = [&](const QString& text) {
    auto* label = new QLabel(text);
    label->setFont(theme::smallFont());
    layout->addWidget(label);
  };
  word(tr("height"));
  layout->addWidget(low_);
  word(tr("to"));
  layout->addWidget(high_);
  for (auto* box : {low_, high_}) {
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
            &HeightBandBox::changed);
  }
}

HeightBand HeightBandBox::band() const {
  return {std::min(low_->value(), high_->value()), std::max(low_->value(), high_->value())};
}

void HeightBandBox::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(atHeightColour(), 1));
  painter.setBrush(QColor(12, 14, 17, 225));
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 5, 5);
}

}  // namespace pilothouse::gui
