#include "gui/view/theme.hpp"

#include <QApplication>
#include <QFontDatabase>
#include <QPalette>
#include <QStyleFactory>

namespace pilothouse::gui::theme {

namespace {

// Pixel sizes, so that a screen's odd DPI never breaks the layout; scaling is QT_SCALE_FACTOR's.
QFont sized(int pixels, QFont::Weight weight) {
  static const QString family = [] {
    const QStringList there = QFontDatabase().families();
    for (const char* wanted : {"Open Sans", "Noto Sans", "DejaVu Sans"}) {
      if (there.contains(QLatin1String(wanted))) return QString::fromLatin1(wanted);
    }
    return QApplication::font().family();
  }();
  QFont font(family);
  font.setPixelSize(pixels);
  font.setWeight(weight);
  return font;
}

const char* kSheet = R"(
QMainWindow, QDialog { background: #121519; }
QMainWindow::separator { background: #121519; width: 6px; height: 6px; }
QMainWindow::separator:hover { background: #31506c; }
QMenuBar { background: #121519; color: #e8ecf1; padding: 2px 4px; }
QMenuBar::item { padding: 4px 10px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: #242a32; }
QMenu { background: #1a1e24; color: #e8ecf1; border: 1px solid #313944; padding: 4px; }
QMenu::item { padding: 5px 28px 5px 24px; border-radius: 4px; }
QMenu::item:selected { background: #2b4a66; }
QMenu::item:disabled { color: #6f7a88; }
QMenu::separator { height: 1px; background: #313944; margin: 4px 8px; }
QMenu::indicator { width: 12px; height: 12px; left: 6px; }
QToolTip { background: #242a32; color: #e8ecf1; border: 1px solid #3d4754; padding: 4px 6px; }
QToolButton { background: transparent; color: #a0abb9; border: none; border-radius: 4px; padding: 2px 4px; }
QToolButton:hover { background: #313944; color: #e8ecf1; }
QToolButton[segment] { background: #1a1e24; color: #a0abb9; border: 1px solid #3d4754; padding: 1px 10px; border-radius: 0px; }
QToolButton[segment]:hover { background: #313944; color: #e8ecf1; }
QToolButton[segment]:checked { background: #2b5f8f; color: #ffffff; border-color: #3f7fb8; }
QToolButton[segment]:disabled { color: #6f7a88; background: #1f242b; border-color: #2c333c; }
QToolButton[segment="left"] { border-top-left-radius: 4px; border-bottom-left-radius: 4px; border-right: none; }
QToolButton[segment="right"] { border-top-right-radius: 4px; border-bottom-right-radius: 4px; }
QToolButton[segment="alone"] { border-radius: 4px; }
QToolButton:focus, QPushButton:focus { border: 1px solid #5ab4ff; }
QPushButton { background: #2b3440; color: #e8ecf1; border: 1px solid #3d4754; border-radius: 4px; padding: 5px 16px; }
QPushButton:hover { background: #364252; }
QStatusBar { background: #242a32; border: none; min-height: 32px; }
QStatusBar::item { border: none; }
QScrollArea, QScrollArea > QWidget > QWidget { background: transparent; }
QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar::handle:vertical { background: #3d4754; border-radius: 4px; min-height: 24px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; }
QToolBar { background: #121519; border: none; padding: 0; spacing: 0; }
QSplitter::handle { background: #121519; }
QSlider::groove:horizontal { background: #313944; height: 4px; border-radius: 2px; }
QSlider::sub-page:horizontal { background: #3f7fb8; height: 4px; border-radius: 2px; }
QSlider::handle:horizontal { background: #e8ecf1; width: 14px; margin: -5px 0; border-radius: 7px; }
QDoubleSpinBox, QLineEdit { background: #1a1e24; color: #e8ecf1; border: 1px solid #3d4754; border-radius: 4px; padding: 0 2px; }
QDoubleSpinBox:focus, QLineEdit:focus { border-color: #5ab4ff; }
QTabBar::tab { background: #1a1e24; color: #a0abb9; padding: 5px 14px; border: none; }
QTabBar::tab:selected { background: #242a32; color: #e8ecf1; }
)";

}  // namespace

QFont textFont() {
  return sized(13, QFont::Normal);
}
QFont smallFont() {
  return sized(12, QFont::Normal);
}
QFont titleFont() {
  return sized(13, QFont::DemiBold);
}
QFont headingFont() {
  return sized(17, QFont::DemiBold);
}

void apply(QApplication& application) {
  application.setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  palette.setColor(QPalette::Window, kWindow);
  palette.setColor(QPalette::WindowText, kText);
  palette.setColor(QPalette::Base, kPanel);
  palette.setColor(QPalette::AlternateBase, kRaised);
  palette.setColor(QPalette::Text, kText);
  palette.setColor(QPalette::Button, kRaised);
  palette.setColor(QPalette::ButtonText, kText);
  palette.setColor(QPalette::Highlight, QColor(0x2b, 0x4a, 0x66));
  palette.setColor(QPalette::HighlightedText, kText);
  palette.setColor(QPalette::ToolTipBase, kRaised);
  palette.setColor(QPalette::ToolTipText, kText);
  palette.setColor(QPalette::Link, kAccent);
  palette.setColor(QPalette::Disabled, QPalette::Text, QColor(0x6f, 0x7a, 0x88));
  palette.setColor(QPalette::Disabled, QPalette::WindowText, QColor(0x6f, 0x7a, 0x88));
  application.setPalette(palette);
  application.setFont(textFont());
  application.setStyleSheet(QString::fromLatin1(kSheet));
}

}  // namespace pilothouse::gui::theme
