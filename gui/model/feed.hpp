#pragma once

#include <boost/shared_ptr.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/cloud/checked.hpp"
#include "gui/model/feed_meter.hpp"
#include "gui/model/pace.hpp"

namespace pilothouse::gui {

/// A message on its way to the conversion thread.
template <class Message>
struct Arrival {
  boost::shared_ptr<const Message> message;
  double at = 0.0;       ///< steady time of arrival [s]
  double latency = 0.0;  ///< age on arrival [s]
  std::string topic;
};

/// Holds only the newest message; whoever is too slow loses the older ones.
template <class Message>
class Mailbox {
 public:
  /// @return whether a message that nobody took was overwritten.
  bool put(Arrival<Message> arrival) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool lost = static_cast<bool>(newest_.message);
    newest_ = std::move(arrival);
    return lost;
  }
  /// Empty message when there is nothing new.
  Arrival<Message> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(newest_, {});
  }

 private:
  std::mutex mutex_;
  Arrival<Message> newest_;
};

/// The newest picture of one kind and the health of its stream. Filled by the ROS side, read by the
/// GUI; every call is short and safe from any thread.
template <class Picture>
class Feed {
 public:
  void arrived(double now, std::uint32_t seq, const std::string& publisher,
               const std::string& topic) {
    const std::lock_guard<std::mutex> lock(mutex_);
    meter_.arrived(now, seq, publisher, topic);
  }
  void overwritten() {
    const std::lock_guard<std::mutex> lock(mutex_);
    meter_.overwritten();
  }
  /// The result of converting the message that arrived at `at` with age `latency` [s].
  void deliver(Checked<std::shared_ptr<const Picture>> result, double at, double latency) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!result) {
      meter_.rejected(at, result.reason());
      return;
    }
    if (fresh_) meter_.overwritten();
    newest_ = *result;
    fresh_ = true;
    meter_.accepted(at, latency);
  }
  /// A message was refused before it could be converted.
  void reject(const std::string& reason, double now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    meter_.rejected(now, reason);
  }
  /// The newest picture when it was not taken before and is due, else null.
  /// @param now steady time [s].
  std::shared_ptr<const Picture> take(double now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!fresh_ || !pace_.due(now)) return nullptr;
    fresh_ = false;
    return newest_;
  }
  /// As if nothing had ever come.
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    meter_ = {};
    newest_.reset();
    fresh_ = false;
  }
  std::shared_ptr<const Picture> latest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_;
  }
  FeedState state(double now) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return meter_.state(now);
  }

 private:
  mutable std::mutex mutex_;
  FeedMeter meter_;
  Pace pace_;
  std::shared_ptr<const Picture> newest_;
  bool fresh_ = false;
};

}  // namespace pilothouse::gui
