#pragma once

#include <pilothouse/MapGrid.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include <map>
#include <memory>
#include <string>

#include "gui/model/console_state.hpp"
#include "gui/model/conversion_thread.hpp"
#include "gui/model/errand_thread.hpp"

namespace pilothouse::gui {

/// The subscriptions about the place: map, objects that stay, pose, path, and what the navigator
/// says. Where nobody publishes `pose`, tf tells it. Callbacks run on the spinner thread of the
/// node handle's queue; maps become pictures on a thread of their own, for a large one takes as
/// long as several of the camera's pictures.
class PlaceStreams {
 public:
  PlaceStreams(ros::NodeHandle& node, ConsoleState& state, ConversionThread& conversions,
               const tf2_ros::Buffer& transforms);
  ~PlaceStreams();

 private:
  template <class Message, class Picture>
  void listenToPicture(const std::string& topic, Mailbox<Message>& box, Feed<Picture>& feed);
  template <class Message, class Reading>
  void listenTo(const std::string& topic, Feed<Reading>& feed,
                Checked<Reading> (*convert)(const Message&));
  void listenToMap();
  void listenToPath();
  void lookUpPose();

  ros::NodeHandle& node_;
  ConsoleState& state_;
  ConversionThread& conversions_;
  const tf2_ros::Buffer& transforms_;
  std::shared_ptr<Mailbox<MapGrid>> maps_ = std::make_shared<Mailbox<MapGrid>>();
  ErrandThread map_painter_{[](const std::string&) {}};
  std::map<std::string, ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  std::uint32_t looked_up_ = 0;
  ros::Time looked_up_stamp_;
};

}  // namespace pilothouse::gui
