#pragma once

class QDialog;
class QSize;
class QWidget;

namespace pilothouse::gui {

/// Shows a sheet or a question over the window of `over`, in the place of any other. The stop takes
/// the mouse beside it as ever: the window is not held up, and the bar with the stop stays free.
void showBeside(QDialog& dialog, const QWidget& over);
/// The room for such a sheet, with its frame.
QSize roomBeside(const QWidget& over);

}  // namespace pilothouse::gui
