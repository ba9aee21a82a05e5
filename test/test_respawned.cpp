// A process that starts its work anew when that ends, unless it refuses or an end was asked for.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "doors/respawned.hpp"

namespace pilothouse {
namespace {

/// What the work of a child writes, the test reads.
class Pipe {
 public:
  Pipe() { EXPECT_EQ(pipe(ends_), 0); }
  ~Pipe() {
    for (const int end : ends_) close(end);
  }
  void write(char byte) const { EXPECT_EQ(::write(ends_[1], &byte, 1), 1); }
  /// Waits for the next byte; 0: nobody is left that could write.
  char read() const {
    char byte = 0;
    return ::read(ends_[0], &byte, 1) == 1 ? byte : '\0';
  }
  void closeWriting() {
    close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
};

int respawn(const std::function<int()>& work, bool asked = true) {
  char name[] = "test", option[] = "--respawn";
  char* arguments[] = {name, option, nullptr};
  return runRespawned(asked ? 2 : 1, arguments, work);
}

TEST(Respawned, WhatEndsIsStartedAnewUnlessItRefuses) {
  const Pipe lives;
  int life = 0;
  lives.write('a');
  const int result = respawn([&]() -> int {
    const char mine = lives.read();
    lives.write(static_cast<char>(mine + 1));
    if (mine == 'a') raise(SIGKILL);
    if (mine == 'b') raise(SIGSEGV);
    if (mine == 'c') _exit(0);  // nobody asked for that
    if (mine == 'd') _exit(1);
    ++life;
    _exit(kRefused);
  });
  EXPECT_EQ(result, kRefused);
  EXPECT_EQ(lives.read(), 'f') << "five lives";
  EXPECT_EQ(life, 0) << "in a process of their own";
}

TEST(Respawned, WithoutTheOptionItRunsHere) {
  const pid_t here = getpid();
  EXPECT_EQ(respawn([&] { return getpid() == here ? 5 : 6; }, false), 5);
}

/// Of a watcher, which is killed where it does not end. @return its status.
int statusOf(pid_t watcher) {
  int status = -1;
  for (int i = 0; i < 3000; ++i) {
    if (waitpid(watcher, &status, WNOHANG) == watcher) return status;
    usleep(10'000);
  }
  ADD_FAILURE() << "the watcher does not end";
  kill(watcher, SIGKILL);
  waitpid(watcher, &status, 0);
  return status;
}

// The watcher in a process of its own; its work begins, and never ends by itself.
void expectBothEndBy(int signal) {
  Pipe begun;
  const pid_t watcher = fork();
  if (watcher == 0) {
    _exit(respawn([&]() -> int {
      begun.write('b');
      for (;;) pause();
    }));
  }
  ASSERT_EQ(begun.read(), 'b');
  begun.closeWriting();
  ASSERT_EQ(kill(watcher, signal), 0);
  const int status = statusOf(watcher);
  EXPECT_EQ(begun.read(), '\0') << "nobody runs on, nobody is started anew";
  EXPECT_TRUE(signal == SIGKILL || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

TEST(Respawned, AnEndThatIsAskedForEndsBoth) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) expectBothEndBy(signal);
}

TEST(Respawned, ASignalThatComesRoundTheForkIsNotLost) {
  for (int i = 0; i < 50; ++i) {
    const pid_t watcher = fork();
    if (watcher == 0) {
      _exit(respawn([&]() -> int {
        kill(getppid(), SIGTERM);  // before the watcher waits, or while it does
        for (;;) pause();
      }));
    }
    const int status = statusOf(watcher);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "round " << i;
  }
}

TEST(Respawned, ASignalThatWaitedBeforeTheStartEndsIt) {
  const pid_t watcher = fork();
  if (watcher == 0) {
    sigset_t end;
    sigemptyset(&end);
    sigaddset(&end, SIGTERM);
    sigprocmask(SIG_BLOCK, &end, nullptr);
    raise(SIGTERM);
    _exit(respawn([&]() -> int {
      for (;;) pause();
    }));
  }
  const int status = statusOf(watcher);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(Respawned, EverySignalIsPassedOn) {
  const Pipe begun;
  const pid_t watcher = fork();
  if (watcher == 0) {
    _exit(respawn([&]() -> int {
      static volatile std::sig_atomic_t asked = 0;
      signal(SIGINT, [](int) { asked = 1; });  // which does not yet end it
      begun.write('b');
      while (asked == 0) usleep(1000);
      begun.write('i');
      for (;;) pause();
    }));
  }
  ASSERT_EQ(begun.read(), 'b');
  ASSERT_EQ(kill(watcher, SIGINT), 0);
  ASSERT_EQ(begun.read(), 'i');
  ASSERT_EQ(kill(watcher, SIGTERM), 0);
  const int status = statusOf(watcher);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace pilothouse
