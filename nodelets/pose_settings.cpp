#include "nodelets/pose_settings.hpp"

#include <sstream>

#include "doors/strict_parameters.hpp"

namespace pilothouse {
namespace {

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

PoseSettings readPoseSettings(const ros::NodeHandle& handle) {
  PoseSettings settings;
  std::string scans = "level_scan", match = "scans", stamp = "begin";
  StrictParameters own(handle);
  own.read("base_frame", settings.base_frame);
  own.read("odom_frame", settings.odom_frame);
  own.read("map_frame", settings.map_frame);
  own.read("scans", scans);
  own.read("match", match, {"scans", "map"});
  own.read("scan_stamp", stamp, {"begin", "end"});
  const auto read = [&own](const char* key, auto& value, auto low, auto high) {
    own.read(key, value, low, high);
  };
  forEachTrackerParameter(settings.tracker, read);
  forEachIcpParameter(settings.icp, read);
  settings.scans = wordsOf(scans);
  if (settings.scans.empty() || settings.scans.size() > 8) {
    own.addFault("scans is '" + scans + "', expected 1 to 8 topics with spaces between");
  }
  own.finish();
  settings.given_map = match == "map";
  settings.stamped_at_end = stamp == "end";
  return settings;
}

}  // namespace pilothouse
