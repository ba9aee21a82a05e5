#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "gui/model/clock.hpp"
#include "gui/model/teleop.hpp"

namespace pilothouse::gui {

/// Counts the stops that were pressed.
using StopSerial = std::uint64_t;

/// A sign of life of this console.
struct Beat {
  bool stop = false;
  bool driving = false;
  bool leaving = false;
  std::uint32_t gate_beat = 0;
};

/// Where the helm's messages go. Called from the helm's own thread; must never wait for anything.
class HelmOutput {
 public:
  virtual ~HelmOutput() = default;
  virtual void beat(const Beat& beat) = 0;
  virtual void drive(const Twist2& command) = 0;
};

/// What the window shows of the helm.
struct HelmView {
  bool stop = false;
  bool driving = false;
  bool slow = false;
  bool forward = false, back = false, left = false, right = false;
  bool side_left = false, side_right = false;
  Twist2 command;
  HandsOff reason = HandsOff::kNone;
};

/// The operator's hand on the robot: stop, sign of life and driving by hand, on a thread of its own
/// that no busy window delays. The window and the key watcher only leave wishes here; every call
/// is short and safe from any thread.
class Helm {
 public:
  static constexpr double kBeatPeriod = 0.05;    ///< [s]: 20 Hz
  static constexpr double kWindowHangs = 0.5;    ///< without a sign of the window driving ends [s]
  static constexpr double kMovesFor = 0.2;       ///< after the limiter said so [s]
  static constexpr double kGateForgotten = 1.0;  ///< an older state of the gate hinders nothing [s]

  explicit Helm(const BaseParameters& base);
  ~Helm();
  Helm(const Helm&) = delete;
  Helm& operator=(const Helm&) = delete;

  /// Latched until release(). Takes no lock.
  void stop();
  bool stopped() const;
  /// How many were pressed so far.
  StopSerial stops() const { return stops_; }
  /// Takes back the stops up to this one: the first half of arming. One that was pressed later
  /// holds. The gate stays latched until it is armed.
  void release(StopSerial stops);

  void press(KeyMeaning key);
  /// Arrow keys aim on the map. While somebody drives by hand they drive all the same, and an arrow
  /// pressed to aim never begins to drive: it must be let go and pressed anew.
  void setArrowsAim(bool on) { arrows_aim_ = on; }
  /// Whether an arrow pressed now aims.
  bool arrowsAim() const;
  void letGo(KeyMeaning key);
  void stick(std::optional<Twist2> deflection);
  void setCap(double cap);

  /// The window lives; called by the GUI thread many times a second.
  void windowLives();
  /// Whether driving keys mean driving: false while typing or when a dialog is open.
  void setKeysDrive(bool on) { keys_drive_ = on; }
  /// One of our windows is the active one. Without it nothing drives.
  void setActive(bool on);
  /// The same as the X server says, which needs no living GUI thread; both must be true.
  void setFocused(bool on);

  /// The gate's newest state. @param latched it holds the robot until it is armed.
  void gateSays(std::uint32_t beat, bool latched);

  /// The limiter lets the robot move now.
  void limiterMoves() { moves_at_ = steadySeconds(); }

  /// Null: no connection.
  void connect(std::shared_ptr<HelmOutput> output);
  void start();
  /// Says that the console leaves, with a last zero where one is due, and ends the thread.
  void leave();

  HelmView view() const;

 private:
  void run();
  void step(double now);
  void sendBeat(double now);
  void nudge();
  HandsOff hindrance(double now) const;

  std::atomic<bool> arrows_aim_{false};
  std::atomic<StopSerial> stops_{0}, released_{0};  ///< stopped while they differ
  std::atomic<bool> keys_drive_{true}, latched_{false};
  std::atomic<bool> active_{false}, focused_{true};
  std::atomic<double> window_at_{-1e9}, gate_at_{-1e9}, moves_at_{-1e9};
  std::atomic<std::uint32_t> gate_beat_{0};
  std::atomic<bool> hurry_{false};

  mutable std::mutex mutex_;  ///< of the state machine and of the thread's end
  std::condition_variable wake_;
  Teleop teleop_;
  bool ending_ = false;

  std::mutex output_mutex_;
  std::shared_ptr<HelmOutput> output_;
  double next_beat_ = 0.0;
  bool said_stop_ = false, said_driving_ = false;
  std::thread thread_;
};

}  // namespace pilothouse::gui
