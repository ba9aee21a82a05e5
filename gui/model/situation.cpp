#include "gui/model/situation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pilothouse::gui {

namespace {

constexpr double kMasterHangs = 4.0;  // s; it is asked once or twice a second

std::string seconds(double s) {
  char text[32];
  if (s < 100.0) {
    std::snprintf(text, sizeof text, "%d s", static_cast<int>(std::floor(s)));
  } else {
    std::snprintf(text, sizeof text, "%d min", static_cast<int>(std::floor(s / 60.0)));
  }
  return text;
}

void aboutLink(const Situation& s, std::vector<Notice>& out) {
  switch (s.link.phase) {
    case LinkPhase::kStarting:
      out.push_back({Severity::kNote, "looking for the master at " + s.link.master_uri});
      break;
    case LinkPhase::kNoMaster:
      out.push_back({Severity::kWarning, "no master at " + s.link.master_uri + ": waiting"});
      break;
    case LinkPhase::kLost:
      out.push_back({Severity::kError, "lost the master at " + s.link.master_uri + " " +
                                           seconds(s.now - s.link.since) + " ago: reconnecting"});
      break;
    case LinkPhase::kConnected:
      break;
  }
}

void aboutStream(const Situation& s, const ExpectedStream& stream, std::vector<Notice>& out) {
  const FeedState& state = stream.state;
  const std::string& topic = stream.topic;
  if (!state.rejection.empty()) {
    out.push_back({Severity::kError, stream.what + " rejected: " + state.rejection});
  }
  const Severity severity = stream.essential ? Severity::kWarning : Severity::kNote;
  const bool connected = s.link.phase == LinkPhase::kConnected;
  if (!state.ever) {
    if (!connected) return;  // who publishes is the master's to tell
    if (!stream.advertised) {
      out.push_back({severity, "no " + stream.what + ": nobody publishes " + topic});
    } else if (s.now - s.link.since >= 1.0 && state.rejection.empty()) {
      out.push_back({severity, "no " + stream.what + " yet on " + topic});
    }
  } else if (state.age_s > kStaleAfter) {
    out.push_back({stream.essential ? Severity::kError : severity,
                   "no " + stream.what + " for " + seconds(state.age_s) + " on " +
                       (state.topic.empty() ? topic : state.topic)});
  }
}

}  // namespace

LinkStatus linkAt(LinkStatus link, double now) {
  const bool hangs = link.looked_at > 0.0 && now - link.looked_at > kMasterHangs;
  if (link.phase == LinkPhase::kConnected && hangs) {
    link.phase = LinkPhase::kLost;
    link.since = link.looked_at;
  }
  return link;
}

std::vector<Notice> notices(const Situation& situation) {
  std::vector<Notice> out;
  aboutLink(situation, out);
  // What was connected before the master went goes on without it.
  const LinkPhase phase = situation.link.phase;
  if (phase == LinkPhase::kConnected || phase == LinkPhase::kLost) {
    for (const auto& stream : situation.streams) aboutStream(situation, stream, out);
    if (situation.depth_without_info) {
      out.push_back({Severity::kWarning,
                     "no " + situation.info_topic + ": the floor cannot be judged without it"});
    }
    if (!situation.missing_transform.empty()) {
      out.push_back({Severity::kWarning, "no transform from " + situation.missing_transform});
    }
    for (const auto& complaint : situation.complaints) {
      out.push_back({complaint.error ? Severity::kError : Severity::kWarning,
                     complaint.name + ": " + complaint.message});
    }
    if (!situation.answer.text.empty()) {
      out.push_back(
          {situation.answer.done ? Severity::kNote : Severity::kWarning, situation.answer.text});
    }
    if (!situation.route.empty()) out.push_back({Severity::kNote, situation.route});
    if (!situation.link.robot.empty() && situation.link.robot != situation.robot) {
      out.push_back({Severity::kWarning, "the running robot is " + situation.link.robot +
                                             ", this console draws " + situation.robot});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Notice& a, const Notice& b) {
    return static_cast<int>(a.severity) > static_cast<int>(b.severity);
  });
  if (out.empty()) out.push_back({Severity::kGood, "all streams arrive"});
  return out;
}

}  // namespace pilothouse::gui
