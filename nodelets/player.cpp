#include "nodelets/player.hpp"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <exception>

namespace pilothouse {

void Player::onInit() {
  ros::NodeHandle& handle = getNodeHandle();
  StrictParameters parameters(getPrivateNodeHandle());
  parameters.read("rate", rate_, 0.01, 1000.0);
  parameters.read("loop", loop_);
  parameters.accept("diagnostic_period");  // the updater's own
  configure(parameters);
  parameters.finish();

  advertise(handle);
  diagnostics_ =
      std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
  diagnostics_->setHardwareID("files");
  diagnostics_->add("player", this, &Player::report);
  timer_ = handle.createWallTimer(ros::WallDuration(1.0 / rate_),
                                  [this](const ros::WallTimerEvent&) { tick(); });
  diagnostics_timer_ = handle.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });
}

void Player::open() {
  opened_ = true;
  try {
    names_ = openSource();
  } catch (const std::exception& fault) {
    refuse(getName(), fault.what());
  }
  refused_.assign(names_.size(), false);
  const std::lock_guard<std::mutex> lock(mutex_);
  frames_ = names_.size();
  finished_ = names_.empty();
}

void Player::tick() {
  if (!opened_) open();
  // Without a listener the first frames would be lost, which matters when they come only once.
  if (names_.empty() || !hasListeners()) return;
  for (std::size_t tried = 0; tried < names_.size(); ++tried) {
    if (next_ == names_.size() && !loop_) break;
    const std::size_t frame = next_ == names_.size() ? 0 : next_;
    next_ = frame + 1;
    if (refused_[frame]) continue;
    try {
      play(frame, ros::Time::now());
      const std::lock_guard<std::mutex> lock(mutex_);
      ++played_;
      return;
    } catch (const std::exception& fault) {
      refused_[frame] = true;
      refuse(names_[frame], fault.what());
    }
  }
  timer_.stop();
  const std::lock_guard<std::mutex> lock(mutex_);
  finished_ = true;
}

void Player::refuse(const std::string& name, const std::string& reason) {
  NODELET_ERROR_STREAM("Not playing " << name << ": " << reason);
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refusals_;
  last_reason_ = name + ": " + reason;
}

void Player::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool nothing = refusals_ > 0 && refusals_ >= frames_;
  if (nothing)
    status.summary(DiagnosticStatus::ERROR, "nothing to play: " + last_reason_);
  else if (refusals_ > 0)
    status.summary(DiagnosticStatus::WARN, "left out " + last_reason_);
  else
    status.summary(DiagnosticStatus::OK, finished_ ? "played" : "playing");
  status.add("files", frames_);
  status.add("frames published", played_);
  status.add("files refused", refusals_);
  status.add("last refusal", last_reason_);
}

}  // namespace pilothouse
