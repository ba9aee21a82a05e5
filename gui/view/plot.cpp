#include "gui/view/plot.hpp"

#include <QMouseEvent>
#include <QStringList>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kLeftRoom = 38.0;   // px of the values' labels
constexpr double kLegendRow = 20.0;  // px
constexpr double kBand = 13.0;       // px of the rules
constexpr double kAxisRoom = 18.0;   // px of the times' labels
constexpr double kLeastSpan = 0.5;   // s
constexpr double kMostSpan = 120.0;  // s

}  // namespace

Plot::Plot(GraphTime& time, const QString& title, const QString& unit, double least_top,
           QWidget* parent)
    : QWidget(parent), time_(time), title_(title), unit_(unit), least_top_(least_top) {
  setMouseTracking(true);
  setMinimumSize(160, 36);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  high_ = least_top;
}

Series& Plot::seriesOf(const QString& name, const QColor& colour, double width) {
  for (auto& series : series_) {
    if (series.name == name) return series;
  }
  Series series;
  series.name = name;
  series.colour = colour;
  series.width = width;
  series_.push_back(std::move(series));
  return series_.back();
}

int Plot::columns() const {
  return std::max(1, static_cast<int>(field().width()));
}

double Plot::bandTop() const {
  double bottom = 4.0;
  for (const auto& chip : chips()) bottom = std::max(bottom, chip.box.bottom());
  return bottom + 2.0;
}

QRectF Plot::field() const {
  const double top = bandTop() + (rule_band_ ? kBand + 2.0 : 2.0);
  const double bottom = height() - (time_axis_ ? kAxisRoom : 6.0);
  return {kLeftRoom, top, std::max(10.0, width() - kLeftRoom - 8.0), std::max(10.0, bottom - top)};
}

QPointF Plot::toPixel(double t, double value) const {
  return toPixel(field(), t, value);
}

QPointF Plot::toPixel(const QRectF& f, double t, double value) const {
  return {f.left() + (t - time_.begin()) / time_.span * f.width(),
          f.bottom() - (value - low_) / (high_ - low_) * f.height()};
}

double Plot::timeAt(double x) const {
  const QRectF f = field();
  return time_.begin() + (x - f.left()) / f.width() * time_.span;
}

// Grows at once and shrinks only when half the height is empty: a scale that breathes is
// unreadable.
void Plot::chooseScale() {
  if (free_scale_) return;
  double most = least_top_;
  for (const auto& series : series_) {
    if (!series.shown || !series.scales) continue;
    for (const auto& point : series.points) {
      if (point.value > most) most = point.value;
    }
  }
  for (const auto& level : levels_) most = std::max(most, level.value);
  const double step = std::pow(10.0, std::floor(std::log10(most)));
  const double nice = std::ceil(most * 1.06 / (0.2 * step)) * 0.2 * step;
  low_ = 0.0;
  if (nice > high_ || nice < high_ * 0.5) high_ = nice;
}

std::vector<Plot::Chip> Plot::chips() const {
  const QFontMetricsF metrics(theme::smallFont());
  std::vector<Chip> out;
  double x = kLeftRoom;
  double y = 3.0;
  x += metrics.horizontalAdvance(title_) + 14.0;
  const double figures = metrics.horizontalAdvance("00.00");
  for (std::size_t i = 0; i < series_.size(); ++i) {
    const double wide = 20.0 + metrics.horizontalAdvance(series_[i].name) + 5.0 + figures;
    if (x + wide > width() - 4.0 && x > kLeftRoom + 1.0) {
      x = kLeftRoom;
      y += kLegendRow;
    }
    double value = time_.cursor ? series_[i].under_cursor : series_[i].newest;
    if (std::abs(value) < 0.005) value = 0.0;  // never "-0.00"
    out.push_back({QRectF(x, y, wide, kLegendRow - 2.0), i,
                   std::isfinite(value) ? QString::number(value, 'f', 2) : QString("-")});
    x += wide + 8.0;
  }
  return out;
}

QRectF Plot::legendBox(const QString& name) const {
  for (const auto& chip : chips()) {
    if (series_[chip.series].name == name) return chip.box;
  }
  return {};
}

const RuleStretch* Plot::ruleAt(double t) const {
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    if (rules_[i].at <= t && t < endOf(i)) return &rules_[i];
  }
  return nullptr;
}

// The last one holds until its next report is overdue.
double Plot::endOf(std::size_t rule) const {
  const double until = rules_[rule].until;
  return rule + 1 < rules_.size() ? until : std::min(time_.now, until + Trace::kGap);
}

QString Plot::readoutText(bool with_values) const {
  if (!time_.cursor || !inside_) return {};
  QStringList words;
  words << tr("%1 s").arg(*time_.cursor - time_.now, 0, 'f', 2);
  for (const auto& series : series_) {
    if (!with_values) break;
    if (!series.shown || !std::isfinite(series.under_cursor)) continue;
    words << tr("%1 %2 %3").arg(series.name).arg(series.under_cursor, 0, 'f', 3).arg(unit_);
  }
  if (rule_band_) {
    const auto* rule = ruleAt(*time_.cursor);
    words << (rule ? QString::fromStdString(rule->words) : tr("nobody told what ruled"));
  }
  return words.join('\n');
}

void Plot::wheelEvent(QWheelEvent* event) {
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
  const QPointF place = event->position();
#else
  const QPointF place = event->posF();
#endif
  const double factor = std::pow(1.0015, -event->angleDelta().y());
  if (event->modifiers() & Qt::ControlModifier) {
    const QRectF f = field();
    const double share = std::clamp((f.bottom() - place.y()) / f.height(), 0.0, 1.0);
    const double value = low_ + share * (high_ - low_);
    const double height = std::clamp((high_ - low_) * factor, 0.01, 1000.0);
    free_scale_ = true;
    low_ = value - share * height;
    high_ = low_ + height;
  } else {
    const double t = timeAt(place.x());
    const double share = (t - time_.begin()) / time_.span;
    time_.span = std::clamp(time_.span * factor, kLeastSpan, kMostSpan);
    // Live, the right end keeps running; held, the time under the cursor stays where it is.
    if (time_.held) time_.held = std::min(time_.now, t + (1.0 - share) * time_.span);
  }
  event->accept();
  emit changed();
}

void Plot::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  for (const auto& chip : chips()) {
    if (!chip.box.contains(event->localPos())) continue;
    series_[chip.series].shown = !series_[chip.series].shown;
    emit changed();
    return;
  }
  dragged_from_ = event->localPos();
}

void Plot::mouseMoveEvent(QMouseEvent* event) {
  const QRectF f = field();
  if (dragged_from_ && (event->buttons() & Qt::LeftButton)) {
    const double moved = (event->localPos().x() - dragged_from_->x()) / f.width() * time_.span;
    if (std::abs(event->localPos().x() - dragged_from_->x()) >= 2.0) {
      time_.held = std::min(time_.now, time_.end() - moved);
      dragged_from_ = event->localPos();
    }
  }
  inside_ = event->localPos().x() >= f.left() && event->localPos().x() <= f.right();
  if (inside_) {
    time_.cursor = timeAt(event->localPos().x());
  } else {
    time_.cursor.reset();
  }
  emit changed();
}

void Plot::mouseReleaseEvent(QMouseEvent*) {
  dragged_from_.reset();
}

void Plot::mouseDoubleClickEvent(QMouseEvent*) {
  free_scale_ = false;
  time_.held.reset();
  time_.span = GraphTime::kUsualSpan;
  emit changed();
}

void Plot::leaveEvent(QEvent*) {
  inside_ = false;
  time_.cursor.reset();
  emit changed();
}

}  // namespace pilothouse::gui
