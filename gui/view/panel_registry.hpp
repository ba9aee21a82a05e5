#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gui/view/panel.hpp"

namespace pilothouse::gui {

/// The wide left, the row of pictures at the top right, or below it.
enum class PanelPlace { kMain, kPicture, kGraph };

struct PanelEntry {
  std::string id;  ///< of the saved layout; never changes
  QString title;
  PanelPlace place;
  int order;   ///< within its place, and in the menu
  bool shown;  ///< at the first start
  std::function<Panel*(const PanelContext&)> make;
  /// Why the panel cannot be had on this machine; empty: it can. May be null.
  std::function<QString()> hindrance;
};

/// All panels of the program, by order.
std::vector<PanelEntry> panelRegistry();

/// A namespace-scope object of this type in the panel's file enters it.
struct PanelRegistration {
  explicit PanelRegistration(PanelEntry entry);
};

}  // namespace pilothouse::gui
