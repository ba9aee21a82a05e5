#include "gui/view/panel_registry.hpp"

#include <algorithm>

namespace pilothouse::gui {

namespace {

std::vector<PanelEntry>& entries() {
  static std::vector<PanelEntry> all;
  return all;
}

}  // namespace

PanelRegistration::PanelRegistration(PanelEntry entry) {
  entries().push_back(std::move(entry));
}

std::vector<PanelEntry> panelRegistry() {
  auto sorted = entries();
  // By place and order: the files are linked in no order that one could rely on.
  std::sort(sorted.begin(), sorted.end(), [](const PanelEntry& a, const PanelEntry& b) {
    return std::tie(a.place, a.order, a.id) < std::tie(b.place, b.order, b.id);
  });
  return sorted;
}

}  // namespace pilothouse::gui
