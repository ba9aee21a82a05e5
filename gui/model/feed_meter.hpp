#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace pilothouse::gui {

/// What a header strip shows of one stream of pictures.
struct FeedState {
  bool ever = false;           ///< a picture was accepted at least once
  double rate_hz = 0.0;        ///< arrivals a second over the last 4 s; 0 with fewer than two
  double age_s = 0.0;          ///< of the newest accepted picture; meaningful when `ever`
  std::uint64_t drops = 0;     ///< lost on the way or overwritten before they were drawn
  std::uint64_t rejected = 0;  ///< refused by the checks
  std::string rejection;       ///< why the last message was refused; empty when it was accepted
                               ///< or none came for 5 s
  std::string topic;           ///< where the newest message came from
};

enum class Freshness { kNever, kFresh, kLate, kStale };

/// Late (amber) after 2.5 usual periods but not before 0.5 s; stale (red) after 3 s.
Freshness freshness(const FeedState& state);
constexpr double kStaleAfter = 3.0;  ///< [s]

/// Rate, age and drops of one stream. Every time is an argument, in seconds of one steady clock.
/// A drop is a gap in the sequence numbers of one publisher, or a message that a newer one replaced
/// before it was drawn.
class FeedMeter {
 public:
  /// @param seq header sequence number; @param publisher who sent it: only numbers of one publisher
  /// follow each other.
  void arrived(double now, std::uint32_t seq, const std::string& publisher,
               const std::string& topic);
  void overwritten() { ++drops_; }
  /// The message that arrived at `arrival` was accepted. @param latency age that it already had on
  /// arrival [s], 0 where its stamp is of another clock.
  void accepted(double arrival, double latency);
  void rejected(double now, const std::string& reason);
  FeedState state(double now) const;

 private:
  std::deque<double> arrivals_;
  std::string publisher_, topic_, rejection_;
  std::uint32_t seq_ = 0;
  std::uint64_t drops_ = 0, rejected_ = 0;
  double origin_ = 0.0, rejected_at_ = 0.0;
  bool ever_ = false;
};

}  // namespace pilothouse::gui
