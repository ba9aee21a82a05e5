#pragma once

#include <ros/node_handle.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gui/model/console_state.hpp"
#include "gui/model/helm.hpp"

namespace pilothouse::gui {

/// The subscriptions of the driving side: limit, gate, wheels, rangers, contacts, route, wishes and
/// the simulated clock. Callbacks run on the spinner thread of the node handle's queue; every
/// sample counts for the graphs, so they check and store at once.
class DriveStreams {
 public:
  /// @param helm hears of the gate; may be null.
  DriveStreams(ros::NodeHandle& node, ConsoleState& state, Helm* helm);
  ~DriveStreams();

  /// Subscribes to the rangers in sight and, where time is simulated, to the clock.
  void review(const std::set<std::string>& advertised);
  /// Notes that a message on the topic was refused, for the status line.
  void refused(const std::string& topic, const std::string& reason);

 private:
  template <class Message, class Store>
  void listen(const std::string& topic, Store store);
  template <class Message, class Reading, class Use>
  void listenTo(const std::string& topic, Feed<Reading>& feed,
                Checked<Reading> (*convert)(const Message&), Use use);
  void listenToRanger(const std::string& topic, const std::string& name);
  void listenToWishes(const std::string& source);

  ros::NodeHandle& node_;
  ConsoleState& state_;
  Helm* helm_;
  std::map<std::string, ros::Subscriber> subscribers_;
};

}  // namespace pilothouse::gui
