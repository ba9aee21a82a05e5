#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Config.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <functional>
#include <memory>
#include <string>

#include "gui/model/conversion_thread.hpp"
#include "gui/model/diagnostics_board.hpp"
#include "gui/model/drive_streams.hpp"
#include "gui/model/place_streams.hpp"
#include "gui/model/rewind_watch.hpp"

namespace pilothouse::gui {

/// The subscriptions of one connection. Callbacks run on their own spinner thread and only put
/// messages into mailboxes. Made, reviewed and destroyed by the link thread.
class RosStreams {
 public:
  /// The master must have answered just before: some of ROS waits for it.
  /// @param helm hears of the gate; may be null.
  explicit RosStreams(ConsoleState& state, Helm* helm = nullptr);
  ~RosStreams();

  /// Once or twice a second: chooses between sources, looks at tf, publishes the topics in sight.
  void review();

 private:
  template <class Message>
  ros::Subscriber listen(
      const std::string& topic,
      const boost::function<void(const ros::MessageEvent<const Message>&)>& receive,
      const std::function<void(const std::string&)>& refused, std::uint32_t queue = 2);
  template <class Message, class Picture>
  ros::Subscriber subscribe(const std::string& topic, Mailbox<Message>& box, Feed<Picture>& feed);
  ros::Subscriber subscribeCloud();
  void chooseSources();
  void lookAtTransforms();
  void announced(const dynamic_reconfigure::Config& config);

  ConsoleState& state_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ConversionThread conversions_;
  DiagnosticsBoard diagnostics_;
  tf2_ros::Buffer transforms_;
  RewindWatch rewind_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;
  ros::WallTimer forget_;
  ros::Subscriber rewinds_, depth_, info_, cloud_, colour_, coded_, floor_, objects_, complaints_,
      settings_;
  DriveStreams drive_;
  PlaceStreams place_;
  double began_;
  ros::AsyncSpinner spinner_;
};

}  // namespace pilothouse::gui
