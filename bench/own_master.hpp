#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace pilothouse::bench {

/// A ROS master of this process's own on a free port of the loopback, with its logs in a folder
/// that goes when it goes, so that a benchmark neither needs nor disturbs a running system. Sets
/// ROS_MASTER_URI, ROS_IP, ROS_HOME and ROS_LOG_DIR: make it before ros::init.
class OwnMaster {
 public:
  /// @throws std::runtime_error when it cannot be started.
  OwnMaster();
  ~OwnMaster();
  OwnMaster(const OwnMaster&) = delete;
  OwnMaster& operator=(const OwnMaster&) = delete;

  /// To be called after ros::init. @throws std::runtime_error when it does not answer within 20 s.
  void waitUntilUp() const;

 private:
  std::string folder_;
  pid_t process_ = -1;
};

/// Starts a program with these arguments, found by PATH. @throws std::runtime_error.
/// @param log file that its output and errors replace; empty: they are this process's own.
pid_t startProcess(const std::vector<std::string>& arguments, const std::string& log = {});

}  // namespace pilothouse::bench
