#pragma once

#include <QColor>
#include <QFont>

class QApplication;

namespace pilothouse::gui::theme {

// Colours of the one dark theme. State is never told by colour alone: a word stands beside it.
const QColor kWindow(0x12, 0x15, 0x19);
const QColor kPanel(0x1a, 0x1e, 0x24);
const QColor kRaised(0x24, 0x2a, 0x32);
const QColor kLine(0x31, 0x39, 0x44);
const QColor kText(0xe8, 0xec, 0xf1);
const QColor kMuted(0xa0, 0xab, 0xb9);
const QColor kAccent(0x5a, 0xb4, 0xff);
const QColor kGood(0x56, 0xd3, 0x9b);
const QColor kWarning(0xff, 0xc1, 0x4d);
const QColor kError(0xff, 0x7b, 0x6e);

constexpr int kSpace = 8;         ///< the unit of all margins [px]
constexpr int kStripHeight = 32;  ///< header strips and status line [px]

QFont textFont();     ///< body text
QFont smallFont();    ///< labels in pictures, figures in strips
QFont titleFont();    ///< panel titles
QFont headingFont();  ///< heading of an empty panel

/// Palette, stylesheet and font for the whole application.
void apply(QApplication& application);

}  // namespace pilothouse::gui::theme
