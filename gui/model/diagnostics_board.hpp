#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <map>
#include <string>
#include <vector>

#include "gui/model/situation.hpp"

namespace pilothouse::gui {

/// Remembers which diagnostics are not OK. An entry that nobody repeats is forgotten.
class DiagnosticsBoard {
 public:
  void update(const diagnostic_msgs::DiagnosticArray& array, double now);
  std::vector<Complaint> complaints(double now) const;

 private:
  struct Entry {
    Complaint complaint;
    double at;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace pilothouse::gui
