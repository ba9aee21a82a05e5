#pragma once

#include <string>
#include <vector>

#include "gui/model/feed_meter.hpp"
#include "gui/model/place_asks.hpp"

namespace pilothouse::gui {

enum class LinkPhase { kStarting, kNoMaster, kConnected, kLost };

/// State of the connection to the ROS master.
struct LinkStatus {
  LinkPhase phase = LinkPhase::kStarting;
  std::string master_uri;
  double round_trip_ms = 0.0;   ///< of the last question to the master
  bool simulated_time = false;  ///< ROS time comes from /clock
  double since = 0.0;           ///< steady time when the phase began [s]
  std::string robot;            ///< /robot/name of the running system; empty when unknown
  double looked_at = 0.0;       ///< steady time of the last answer or its lack [s]; 0: none yet
};

/// The status as it is now: a master that hangs lets nobody say that it is lost.
LinkStatus linkAt(LinkStatus link, double now);

/// One stream that the operator expects.
struct ExpectedStream {
  std::string what;   ///< "depth"
  std::string topic;  ///< "camera/depth/image_rect"
  bool advertised = false;
  bool essential = true;  ///< absence is worth a warning
  FeedState state;
};

/// One entry of the diagnostics that is not OK.
struct Complaint {
  std::string name, message;
  bool error = false;
};

/// Everything that the status sentence is made from. Times are steady seconds.
struct Situation {
  double now = 0.0;
  LinkStatus link;
  std::vector<ExpectedStream> streams;
  bool depth_without_info = false;  ///< depth images arrive, camera_info does not
  std::string info_topic;
  std::string missing_transform;  ///< "base_link to camera_depth_optical_frame"; empty: none
  std::vector<Complaint> complaints;
  AskAnswer answer;   ///< to what the operator asked a moment ago; without text: nothing
  std::string route;  ///< what the task does, in words; empty: nothing
  std::string robot;  ///< whose YAML the console has read
};

enum class Severity { kGood, kNote, kWarning, kError };

struct Notice {
  Severity severity;
  std::string text;  ///< a sentence for the operator
};

/// What the operator should know, the worst first; one good notice when all is well.
std::vector<Notice> notices(const Situation& situation);

}  // namespace pilothouse::gui
