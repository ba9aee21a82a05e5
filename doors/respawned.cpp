#include "doors/respawned.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace pilothouse {
namespace {

constexpr long kDelay_ns = 200'000'000;  // so that one who crashes at once leaves others time

volatile std::sig_atomic_t end_asked = 0;

void handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: waiting ends
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// Waits until it ends, and passes a signal on. @return its status.
int watch(pid_t child) {
  int status = 0;
  bool told = false;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    if (end_asked != 0 && !told) kill(child, end_asked);
    told = end_asked != 0;
  }
  return status;
}

}  // namespace

int runRespawned(int argc, char** argv, const std::function<int()>& work) {
  const bool respawns = std::any_of(argv, argv + argc,
                                    [](const char* a) { return std::strcmp(a, "--respawn") == 0; });
  if (!respawns) return work();
  const pid_t watcher = getpid();
  handle([](int signal) { end_asked = signal; });
  while (end_asked == 0) {
    const pid_t child = fork();
    if (child < 0) {
      std::perror("cannot start a process");
      return 1;
    }
    if (child == 0) {
      handle(SIG_DFL);
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // whoever kills the watcher means both
      return getppid() == watcher ? work() : 1;
    }
    const int status = watch(child);
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    if (end_asked != 0) break;
    std::fprintf(stderr, "%s: ended by signal %d, started again\n", argv[0], WTERMSIG(status));
    const timespec delay{0, kDelay_ns};
    nanosleep(&delay, nullptr);
  }
  return 0;
}

}  // namespace pilothouse
