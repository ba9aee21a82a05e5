#pragma once

#include <QFontMetrics>
#include <QStringList>
#include <QWidget>

#include "gui/model/situation.hpp"

namespace pilothouse::gui {

/// The line at the bottom: what is missing, in words; which robot, which clock, which master.
/// The tool tip lists what the line has no room for.
class StatusLine : public QWidget {
  Q_OBJECT

 public:
  explicit StatusLine(QWidget* parent = nullptr);
  void show(const Situation& situation);
  /// The sentences as shown.
  QString sentence() const;
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString fitted(const QFontMetrics& metrics, int width) const;

  QStringList sentences_;  ///< the worst first
  Severity severity_ = Severity::kNote;
  QString robot_, clock_, link_;
  bool linked_ = false;
};

}  // namespace pilothouse::gui
