#pragma once

#include <QWidget>
#include <optional>

#include "gui/view/map_drive.hpp"

class QDoubleSpinBox;

namespace pilothouse::gui {

/// Two heights between which objects are picked out on the map. Floats in the map's corner.
class HeightBandBox : public QWidget {
  Q_OBJECT

 public:
  explicit HeightBandBox(QWidget* parent = nullptr);
  HeightBand band() const;

 signals:
  void changed();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QDoubleSpinBox* low_;
  QDoubleSpinBox* high_;
};

}  // namespace pilothouse::gui
