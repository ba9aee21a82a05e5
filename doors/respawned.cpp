#include "doors/respawned.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <initializer_list>

namespace pilothouse {
namespace {

constexpr timespec kDelay{0, 200'000'000};  // so that one who crashes at once leaves others time

sigset_t setOf(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  return set;
}

const sigset_t kEnds = setOf({SIGINT, SIGTERM});
const sigset_t kAwaited = setOf({SIGINT, SIGTERM, SIGCHLD});

/// While it lives they wait until they are asked for: none is lost round a fork.
class HeldSignals {
 public:
  HeldSignals() {
    for (const int each : {SIGINT, SIGTERM, SIGCHLD}) signal(each, SIG_DFL);  // also if ignored
    sigprocmask(SIG_BLOCK, &kAwaited, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

/// Waits until it ends, and passes every signal on. @return its status.
int watch(pid_t child, bool& end_asked) {
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    const int signal = sigwaitinfo(&kAwaited, nullptr);
    if (signal != SIGINT && signal != SIGTERM) continue;
    end_asked = true;
    kill(child, signal);
  }
  return status;
}

void tellEnd(const char* name, int status) {
  if (WIFEXITED(status))
    std::fprintf(stderr, "%s: ended with %d unasked, started again\n", name, WEXITSTATUS(status));
  else
    std::fprintf(stderr, "%s: ended by signal %d, started again\n", name, WTERMSIG(status));
}

}  // namespace

int runRespawned(int argc, char** argv, const std::function<int()>& work) {
  const bool respawns = std::any_of(argv, argv + argc,
                                    [](const char* a) { return std::strcmp(a, "--respawn") == 0; });
  if (!respawns) return work();
  const pid_t watcher = getpid();
  const HeldSignals held;
  for (;;) {
    const pid_t child = fork();
    if (child < 0) {
      std::perror("cannot start a process");
      return 1;
    }
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // whoever kills the watcher means both
      sigprocmask(SIG_UNBLOCK, &kAwaited, nullptr);
      return getppid() == watcher ? work() : 1;
    }
    bool end_asked = false;
    const int status = watch(child, end_asked);
    if (WIFEXITED(status) && (end_asked || WEXITSTATUS(status) == kRefused))
      return WEXITSTATUS(status);
    if (end_asked) return 0;
    tellEnd(argv[0], status);
    if (sigtimedwait(&kEnds, nullptr, &kDelay) > 0) return 0;
  }
}

}  // namespace pilothouse
