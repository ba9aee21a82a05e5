#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace pilothouse {

/// When the gate published each of its newest beats.
class BeatTimes {
 public:
  explicit BeatTimes(std::uint32_t first = 1) : beat_(first) {}
  std::uint32_t next(double steady) {
    times_[++beat_ % times_.size()] = steady;
    if (known_ < times_.size()) ++known_;
    return beat_;
  }
  /// Steady time of a beat [s]; NaN for one that was never published, or too long ago to know.
  double of(std::uint32_t beat) const {
    const std::uint32_t back = beat_ - beat;  // wraps round as the counter does
    return back < known_ ? times_[beat % times_.size()] : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::array<double, 128> times_{};  // longer than any age limit at the gate's fastest rate
  std::uint32_t beat_;
  std::uint32_t known_ = 0;
};

/// The newest pilothouse/Operator of one console.
struct ConsoleMessage {
  std::uint32_t slot_use = 0;  ///< counts the consoles that held this slot; 0: empty
  std::uint32_t count = 0;     ///< messages of this console so far
  std::uint32_t stops = 0;     ///< of them with the stop pressed
  double stamp = 0.0;          ///< by the console's clock, which need not agree with ours [s]
  double arrival = 0.0;        ///< steady clock [s]
  std::uint32_t gate_beat = 0;
  bool stop = false, driving = false, leaving = false;
};

/// What the gate knows of one console over a link that may delay and lose. No clock of the console
/// is trusted: the beat that it says it has seen bounds from above how old its words are.
class ConsoleLink {
 public:
  /// Takes over a message if it is a new one.
  void take(const ConsoleMessage& message, const BeatTimes& beats, double now);

  bool used() const { return slot_use_ != 0; }
  bool left() const { return left_; }
  /// Time since the gate published the newest beat that the console had seen [s]; infinite:
  /// unknown.
  double age(double now) const;
  /// The same for a command stamped by the console's clock: at most this old [s]; infinite:
  /// unknown.
  double commandAge(double stamp, double now) const;
  /// Its last message said that the stop is pressed, and it is not silent for longer than `hold`
  /// [s].
  bool stopPressed(double now, double hold) const { return stop_ && now - heard_ <= hold; }
  /// True once after each message with the stop pressed, also one that a later message overtook.
  bool takeStop();
  /// A person drives from it, or did within `hold` [s].
  bool inCommand(double now, double hold) const { return used() && now - driven_ <= hold; }

 private:
  void boundClock(double beat_time, double arrival, double stamp);

  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::uint32_t slot_use_ = 0, count_ = 0, stops_ = 0;
  bool stop_ = false, left_ = false, stop_taken_ = true;
  double newest_beat_ = kNever, driven_ = kNever, heard_ = kNever;
  // steady = console clock + offset, with the offset between these bounds [s]
  double low_ = kNever, high_ = -kNever, bounded_ = 0.0;
};

}  // namespace pilothouse
