#include "gui/model/helm.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "gui/model/clock.hpp"

namespace pilothouse::gui {

Helm::Helm(const BaseParameters& base) : teleop_(base) {}

Helm::~Helm() {
  leave();
}

void Helm::stop() {
  ++stops_;
  nudge();
}

// What was taken back is read first: a stop that comes between the two is then seen.
bool Helm::stopped() const {
  const StopSerial released = released_;
  return stops_ != released;
}

void Helm::release(StopSerial stops) {
  StopSerial before = released_;
  while (before < stops && !released_.compare_exchange_weak(before, stops)) continue;
  nudge();
}

void Helm::press(KeyMeaning key) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool arrow = key.variant == 1 && key.meaning != DriveKey::kSlow;
    if (arrow && arrows_aim_ && !teleop_.driving()) {
      teleop_.pressElsewhere(key, steadySeconds());
    } else {
      teleop_.press(key, steadySeconds());
    }
  }
  nudge();
}

bool Helm::arrowsAim() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return arrows_aim_ && !teleop_.driving();
}

void Helm::letGo(KeyMeaning key) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    teleop_.release(key, steadySeconds());
  }
  nudge();
}

void Helm::stick(std::optional<Twist2> deflection) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    teleop_.stick(deflection);
  }
  nudge();
}

void Helm::setCap(double cap) {
  const std::lock_guard<std::mutex> lock(mutex_);
  teleop_.setCap(cap);
}

void Helm::windowLives() {
  window_at_ = steadySeconds();
}

void Helm::nudge() {
  hurry_ = true;
  wake_.notify_all();
}

void Helm::setActive(bool on) {
  active_ = on;
  nudge();
}

void Helm::setFocused(bool on) {
  if (focused_.exchange(on) != on) nudge();
}

void Helm::gateSays(std::uint32_t beat, bool latched) {
  gate_beat_ = beat;
  latched_ = latched;
  gate_at_ = steadySeconds();
}

void Helm::connect(std::shared_ptr<HelmOutput> output) {
  // The old one is let go outside the lock: its end may wait for the master.
  const std::lock_guard<std::mutex> lock(output_mutex_);
  output_.swap(output);
}

void Helm::start() {
  ending_ = false;
  thread_ = std::thread([this] { run(); });
}

void Helm::leave() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

HelmView Helm::view() const {
  const double now = steadySeconds();
  const std::lock_guard<std::mutex> lock(mutex_);
  HelmView view;
  view.stop = stopped();
  view.driving = teleop_.driving();
  view.command = teleop_.command();
  view.reason = teleop_.reason();
  view.slow = teleop_.held(DriveKey::kSlow, now);
  view.forward = teleop_.held(DriveKey::kForward, now);
  view.back = teleop_.held(DriveKey::kBack, now);
  view.left = teleop_.held(DriveKey::kTurnLeft, now);
  view.right = teleop_.held(DriveKey::kTurnRight, now);
  view.side_left = teleop_.held(DriveKey::kSideLeft, now);
  view.side_right = teleop_.held(DriveKey::kSideRight, now);
  return view;
}

HandsOff Helm::hindrance(double now) const {
  if (stopped()) return HandsOff::kStopped;
  if (latched_ && now - gate_at_ < kGateForgotten) return HandsOff::kStopped;
  if (now - window_at_ > kWindowHangs) return HandsOff::kWindowHangs;
  if (!active_ || !focused_) return HandsOff::kFocusLost;
  if (!keys_drive_) return HandsOff::kTyping;
  return HandsOff::kNone;
}

void Helm::sendBeat(double now) {
  Beat beat;
  beat.stop = stopped();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    beat.driving = teleop_.driving();
    beat.leaving = ending_;
  }
  const bool news = beat.stop != said_stop_ || beat.driving != said_driving_ || beat.leaving;
  if (!news && now < next_beat_) return;
  next_beat_ =
      now - next_beat_ < kBeatPeriod && !news ? next_beat_ + kBeatPeriod : now + kBeatPeriod;
  said_stop_ = beat.stop;
  said_driving_ = beat.driving;
  beat.gate_beat = gate_beat_;
  const std::lock_guard<std::mutex> lock(output_mutex_);
  if (output_) output_->beat(beat);
}

void Helm::step(double now) {
  bool busy = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    busy = teleop_.busy(now);
  }
  if (busy) {
    const HandsOff why = hindrance(now);
    std::optional<Twist2> command;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      command = teleop_.step(now, why, now - moves_at_ < kMovesFor);
    }
    const std::lock_guard<std::mutex> lock(output_mutex_);
    if (command && output_) output_->drive(*command);
  }
  sendBeat(now);
}

void Helm::run() {
  for (;;) {
    const double now = steadySeconds();
    step(now);
    std::unique_lock<std::mutex> lock(mutex_);
    if (ending_) break;
    // A held key wants its 25 Hz and its debounce; without one only the beat is due. A notice that
    // falls between the two lines is late by no more than this.
    const double pause = teleop_.busy(now) ? 0.004 : std::clamp(next_beat_ - now, 0.001, 0.02);
    wake_.wait_for(lock, std::chrono::duration<double>(pause),
                   [this] { return ending_ || hurry_.exchange(false); });
  }
  std::optional<Twist2> last;
  const double now = steadySeconds();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    teleop_.interrupt(HandsOff::kNone);
    last = teleop_.step(now, HandsOff::kNone);
  }
  {
    const std::lock_guard<std::mutex> lock(output_mutex_);
    if (last && output_) output_->drive(*last);
  }
  sendBeat(now);
}

}  // namespace pilothouse::gui
