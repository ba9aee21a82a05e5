#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <ros/wall_timer.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "doors/strict_parameters.hpp"

namespace pilothouse {

/// What every player of files does: ~rate frames a second (wall time) while anybody listens, in
/// order, over and over if ~loop. Files are opened by the first tick, not while loading, so that a
/// slow disk holds up nobody else in the manager. A frame that is refused is reported with the
/// reason, in the log and in the diagnostics, and left out from then on.
class Player : public nodelet::Nodelet {
 protected:
  /// Reads what this kind of player needs. Opens no file.
  virtual void configure(StrictParameters& parameters) = 0;
  virtual void advertise(ros::NodeHandle& handle) = 0;
  /// Called once, by the first tick. @return the frames' names for messages, in playing order.
  /// @throws std::runtime_error with the reason why nothing can be played.
  virtual std::vector<std::string> openSource() = 0;
  virtual bool hasListeners() const = 0;
  /// Publishes a frame, index into what openSource() returned.
  /// @throws std::exception with the reason why it cannot be played.
  virtual void play(std::size_t frame, const ros::Time& stamp) = 0;

 private:
  void onInit() final;
  void tick();
  void open();
  void refuse(const std::string& name, const std::string& reason);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  double rate_ = 10.0;  ///< Hz
  bool loop_ = true;
  bool opened_ = false;
  std::size_t next_ = 0;
  std::vector<std::string> names_;
  std::vector<bool> refused_;
  ros::WallTimer timer_, diagnostics_timer_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;

  std::mutex mutex_;  ///< of what is reported
  std::size_t frames_ = 0, refusals_ = 0, played_ = 0;
  bool finished_ = false;
  std::string last_reason_ = "none";
};

}  // namespace pilothouse
