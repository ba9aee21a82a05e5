#include "gui/view/header_strip.hpp"

#include <QLayout>
#include <QPainter>
#include <QToolButton>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr int kButton = 22;
constexpr int kFiguresWidth = 190;  // the age and the buttons
constexpr int kColumnGap = 12;
constexpr int kDot = 10;

QString ageText(double age_s) {
  return age_s < 100.0 ? QString::number(age_s, 'f', 1) + " s"
                       : QString::number(static_cast<int>(age_s / 60.0)) + " min";
}

QString countText(std::uint64_t count) {
  return count < 100000 ? QString::number(count) : QString::number(count / 1000) + "k";
}

// A cross and a square, drawn so that no icon theme is needed.
QIcon drawnIcon(bool cross) {
  QPixmap pixmap(32, 32);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme::kMuted, 2.6));
  if (cross) {
    painter.drawLine(9, 9, 23, 23);
    painter.drawLine(23, 9, 9, 23);
  } else {
    painter.drawRect(9, 12, 11, 11);
    painter.drawPolyline(QPolygon({{13, 8}, {24, 8}, {24, 19}}));
  }
  return QIcon(pixmap);
}

}  // namespace

HeaderStrip::HeaderStrip(const QString& title, QWidget* parent)
    : QWidget(parent), title_(title), close_(new QToolButton(this)), float_(new QToolButton(this)) {
  setFixedHeight(theme::kStripHeight);
  const auto prepare = [&](QToolButton* button, bool cross, const QString& tip) {
    button->setIcon(drawnIcon(cross));
    button->setIconSize({16, 16});
    button->setFixedSize(kButton, kButton);
    button->setToolTip(tip);
    button->setFocusPolicy(Qt::NoFocus);
  };
  prepare(close_, true, tr("Hide this panel (View brings it back)"));
  prepare(float_, false, tr("Float or dock"));
  connect(close_, &QToolButton::clicked, this, &HeaderStrip::closeWanted);
  connect(float_, &QToolButton::clicked, this, &HeaderStrip::floatWanted);
}

void HeaderStrip::show(const FeedState& state) {
  state_ = state;
  setToolTip(tr("<b>%1</b><br>%2<br>%3<br>Dropped: lost on the way, or replaced by a newer picture "
                "before it was drawn. Refused so far: %4.")
                 .arg(title_,
                      state.topic.empty() ? tr("nothing received yet")
                                          : QString::fromStdString(state.topic).toHtmlEscaped(),
                      figures())
                 .arg(state.rejected));
  update();
}

QString HeaderStrip::figures() const {
  if (!state_.ever) return tr("no data");
  return tr("%1 Hz   age %2   %3 dropped")
      .arg(state_.rate_hz, 0, 'f', 1)
      .arg(ageText(state_.age_s), countText(state_.drops));
}

void HeaderStrip::addControl(QWidget* control) {
  control_ = control;
  control_->setParent(this);
  control_->setVisible(true);
  placeControl();
}

void HeaderStrip::placeControl() {
  if (!control_) return;
  const QSize size = control_->sizeHint();
  const int left =
      theme::kSpace + 4 + QFontMetrics(theme::titleFont()).horizontalAdvance(title_) + 16;
  control_->setGeometry(left, (height() - size.height()) / 2, size.width(), size.height());
  // Where the strip is short, the figures matter more, or of them at least the buttons' room.
  const int beside = control_needed_ ? 2 * kButton + 14 : kFiguresWidth;
  control_->setVisible(left + size.width() + beside <= width());
}

void HeaderStrip::controlChanged(bool needed) {
  control_needed_ = needed;
  if (control_ && control_->layout()) control_->layout()->activate();
  placeControl();
  update();
}

QSize HeaderStrip::sizeHint() const {
  return {320, theme::kStripHeight};
}
QSize HeaderStrip::minimumSizeHint() const {
  return {150, theme::kStripHeight};
}

void HeaderStrip::resizeEvent(QResizeEvent*) {
  const int top = (height() - kButton) / 2;
  close_->move(width() - kButton - 5, top);
  float_->move(width() - 2 * kButton - 5, top);
  placeControl();
}

void HeaderStrip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::kRaised);
  painter.setFont(theme::titleFont());
  painter.setPen(theme::kText);
  const int left = theme::kSpace + 4;
  painter.drawText(QRect(left, 0, width(), height()), Qt::AlignVCenter | Qt::AlignLeft, title_);

  if (!has_figures_) return;
  paintFigures(painter, control_ && !control_->isHidden()
                            ? control_->geometry().right() + kColumnGap
                            : left + painter.fontMetrics().horizontalAdvance(title_) + kColumnGap);
}

// From the right: drops, age with its state, rate; each right-aligned in a column of its own. Where
// the strip is short the drops go first, then the rate, and at last the age itself: its colour
// stays.
void HeaderStrip::paintFigures(QPainter& painter, int title_end) const {
  painter.setFont(theme::smallFont());
  const QFontMetrics metrics(theme::smallFont());
  int right = width() - 2 * kButton - 14;
  const auto column = [&](const QString& text, int wide, const QColor& colour) {
    painter.setPen(colour);
    painter.drawText(QRect(right - wide, 0, wide, height()), Qt::AlignVCenter | Qt::AlignRight,
                     text);
    right -= wide + kColumnGap;
  };
  if (!state_.ever) {
    const bool waiting = state_.rejection.empty();
    column(waiting ? tr("no data") : tr("rejected"), metrics.horizontalAdvance(tr("rejected")),
           waiting ? theme::kMuted : theme::kError);
    return;
  }
  const int drops = metrics.horizontalAdvance(tr("000 dropped"));
  const int age = metrics.horizontalAdvance(tr("age 00.0 s"));
  const int rate = metrics.horizontalAdvance(tr("00.0 Hz"));
  const int room = right - title_end - age - kDot;
  const bool with_rate = room >= rate + kColumnGap;
  const bool with_drops = room >= rate + drops + 2 * kColumnGap;
  const Freshness fresh = freshness(state_);
  const QColor colour = !state_.rejection.empty() || fresh == Freshness::kStale ? theme::kError
                        : fresh == Freshness::kLate                             ? theme::kWarning
                                                                                : theme::kGood;
  if (with_drops) {
    column(tr("%1 dropped").arg(countText(state_.drops)), drops,
           state_.drops > 0 ? theme::kText : theme::kMuted);
  }
  if (room >= 0) column(tr("age %1").arg(ageText(state_.age_s)), age, colour);
  painter.setBrush(colour);
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(QPointF(right + 2, height() * 0.5), 3.5, 3.5);
  right -= kDot;
  if (with_rate) column(tr("%1 Hz").arg(state_.rate_hz, 0, 'f', 1), rate, theme::kMuted);
}

}  // namespace pilothouse::gui
