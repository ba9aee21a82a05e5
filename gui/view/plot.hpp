#pragma once

#include <QColor>
#include <QString>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "gui/model/telemetry.hpp"

namespace pilothouse::gui {

/// The stretch of time that the graphs of a panel show together, and the cursor they share.
struct GraphTime {
  static constexpr double kUsualSpan = 30.0;  ///< [s]

  double now = 0.0;            ///< steady [s]
  double span = kUsualSpan;    ///< shown [s]
  std::optional<double> held;  ///< the right end stands still here; absent: it runs with now
  std::optional<double> cursor;

  double end() const { return held.value_or(now); }
  double begin() const { return end() - span; }
};

/// One curve of a graph.
struct Series {
  QString name;
  QColor colour;
  double width = 1.6;  ///< px
  Qt::PenStyle style = Qt::SolidLine;
  bool shown = true;
  bool scales = true;              ///< the height of the graph follows it
  std::vector<CurvePoint> points;  ///< of the stretch shown
  double newest = kUnknown;        ///< value now
  double under_cursor = kUnknown;
};

/// A level to compare with, e.g. the stop distance.
struct Level {
  QString name;
  double value;
  QColor colour;
};

/// A live graph. Wheel zooms the time about the cursor, with Ctrl the values; dragging moves; the
/// legend's entries switch curves; a double click runs live again. All of it works while it
/// streams.
class Plot : public QWidget {
  Q_OBJECT

 public:
  /// @param time shared by the graphs of a panel; outlives them.
  Plot(GraphTime& time, const QString& title, const QString& unit, double least_top,
       QWidget* parent = nullptr);

  std::vector<Series>& series() { return series_; }
  /// The series of this name; added with the colour and width when it is new.
  Series& seriesOf(const QString& name, const QColor& colour, double width = 1.6);
  void setLevels(std::vector<Level> levels) { levels_ = std::move(levels); }
  void setRules(std::vector<RuleStretch> rules) { rules_ = std::move(rules); }
  void withTimeAxis(bool on) { time_axis_ = on; }
  void withRules() { rule_band_ = true; }
  /// Columns of pixels that curves are thinned to.
  int columns() const;

  /// Where the curves are drawn.
  QRectF field() const;
  QPointF toPixel(double t, double value) const;
  double timeAt(double x) const;
  /// What the cursor shows; empty when it is elsewhere. @param with_values of the curves too.
  QString readoutText(bool with_values = true) const;
  /// Of an entry of the legend; empty: there is none of this name.
  QRectF legendBox(const QString& name) const;

 signals:
  /// Time, cursor or a switch changed: everything that shares them must be drawn again.
  void changed();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  struct Chip {
    QRectF box;
    std::size_t series;
    QString text;
  };
  std::vector<Chip> chips() const;
  QPointF toPixel(const QRectF& field, double t, double value) const;
  double bandTop() const;
  void chooseScale();
  void paintAxes(QPainter& painter, const QRectF& field) const;
  void paintRules(QPainter& painter, const QRectF& field) const;
  void paintCurves(QPainter& painter, const QRectF& field) const;
  void paintLegend(QPainter& painter) const;
  void paintCursor(QPainter& painter, const QRectF& field) const;
  /// Null: nobody told.
  const RuleStretch* ruleAt(double t) const;
  double endOf(std::size_t rule) const;

  GraphTime& time_;
  QString title_, unit_;
  double least_top_;
  double low_ = 0.0, high_ = 1.0;
  bool free_scale_ = false;  ///< the operator zoomed the values
  bool time_axis_ = true, rule_band_ = false, inside_ = false;
  std::vector<Series> series_;
  std::vector<Level> levels_;
  std::vector<RuleStretch> rules_;
  std::optional<QPointF> dragged_from_;
};

QColor ruleColour(Rule rule);
QString ruleName(Rule rule);

}  // namespace pilothouse::gui
