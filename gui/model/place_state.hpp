#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "gui/model/feed.hpp"
#include "gui/model/guarded.hpp"
#include "gui/model/pictures.hpp"
#include "gui/model/place_asks.hpp"

namespace pilothouse::gui {

/// What the console knows of the place, and the answers to what it asked.
struct PlaceState {
  Feed<MapPicture> map;
  Feed<ObjectsPicture> standing;  ///< objects that stay, in the map's frame
  Feed<PoseReading> pose;
  Feed<NavigationReading> navigation;
  Feed<TaskReading> task;
  Guarded<std::shared_ptr<const PathReading>> path;  ///< that the robot drives; null or empty: none
  Guarded<std::shared_ptr<const Preview>> preview;   ///< newest answer
  Guarded<std::shared_ptr<const RouteShelf>> shelf;  ///< newest answer
  Guarded<AskAnswer> answer;
  std::atomic<std::uint32_t> place{0};  ///< another one where what was known is of elsewhere
  /// What is asked and not answered yet -> since when (steady [s]).
  Guarded<std::map<std::string, double>> asking;

  /// The robot is another one: nothing that was told of the place holds.
  void forget() {
    map.forget();
    standing.forget();
    pose.forget();
    navigation.forget();
    task.forget();
    path.set(nullptr);
    preview.set(nullptr);
    ++place;
  }
};

}  // namespace pilothouse::gui
