#include "gui/model/diagnostics_board.hpp"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <iterator>

namespace pilothouse::gui {

namespace {
constexpr double kForgottenAfter = 10.0;  // s; publishers repeat theirs every second or so
constexpr std::size_t kMostEntries = 200;
constexpr std::size_t kLongest = 200;  // characters
}  // namespace

void DiagnosticsBoard::update(const diagnostic_msgs::DiagnosticArray& array, double now) {
  using Status = diagnostic_msgs::DiagnosticStatus;
  for (auto entry = entries_.begin(); entry != entries_.end();) {  // old names make no room scarce
    entry = now - entry->second.at > kForgottenAfter ? entries_.erase(entry) : std::next(entry);
  }
  for (const auto& status : array.status) {
    if (status.level == Status::OK) {
      entries_.erase(status.name);
    } else if (entries_.size() < kMostEntries || entries_.count(status.name) > 0) {
      entries_[status.name] = {{status.name.substr(0, kLongest), status.message.substr(0, kLongest),
                                status.level == Status::ERROR},
                               now};
    }
  }
}

std::vector<Complaint> DiagnosticsBoard::complaints(double now) const {
  std::vector<Complaint> out;
  for (const auto& entry : entries_) {
    if (now - entry.second.at <= kForgottenAfter) out.push_back(entry.second.complaint);
  }
  return out;
}

}  // namespace pilothouse::gui
