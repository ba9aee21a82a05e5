#include "bench/own_master.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <ros/master.h>
#include <ros/time.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace pilothouse::bench {
namespace {

int freePort() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  const bool found =
      fd >= 0 && bind(fd, generic, size) == 0 && getsockname(fd, generic, &size) == 0;
  if (fd >= 0) close(fd);
  if (!found) throw std::runtime_error("no free port for a ROS master");
  return ntohs(address.sin_port);
}

}  // namespace

pid_t startProcess(const std::vector<std::string>& arguments, const std::string& log) {
  std::vector<char*> raw;
  for (const std::string& argument : arguments) raw.push_back(const_cast<char*>(argument.c_str()));
  raw.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!log.empty()) {
    constexpr mode_t kMode = 0644;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, kMode);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  }
  pid_t process = -1;
  const bool started = posix_spawnp(&process, raw[0], &actions, nullptr, raw.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  if (!started) throw std::runtime_error("cannot start " + arguments[0]);
  return process;
}

OwnMaster::OwnMaster() {
  std::string pattern = std::filesystem::temp_directory_path() / "bench_pipeline-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  folder_ = pattern;
  const std::string port = std::to_string(freePort());
  setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + port).c_str(), 1);
  setenv("ROS_IP", "127.0.0.1", 1);
  setenv("ROS_HOME", folder_.c_str(), 1);
  setenv("ROS_LOG_DIR", folder_.c_str(), 1);
  process_ = startProcess({"rosmaster", "--core", "-p", port});
}

OwnMaster::~OwnMaster() {
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  std::error_code ignored;  // a folder left in /tmp harms nobody
  std::filesystem::remove_all(folder_, ignored);
}

void OwnMaster::waitUntilUp() const {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(20.0);
  while (!ros::master::check()) {
    if (ros::WallTime::now() > deadline) {
      throw std::runtime_error("no answer from the ROS master that was started");
    }
    ros::WallDuration(0.05).sleep();
  }
}

}  // namespace pilothouse::bench
