// A process that starts its work anew when that is killed, and ends when that ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

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

TEST(Respawned, WhatIsKilledOrCrashesIsStartedAnewWhatReturnsIsNot) {
  const Pipe lives;
  int life = 0;
  lives.write('a');
  const int result = respawn([&]() -> int {
    const char mine = lives.read();
    lives.write(static_cast<char>(mine + 1));
    if (mine == 'a') raise(SIGKILL);
    if (mine == 'b') raise(SIGSEGV);
    ++life;
    _exit(7);
  });
  EXPECT_EQ(result, 7);
  EXPECT_EQ(lives.read(), 'd') << "three lives";
  EXPECT_EQ(life, 0) << "in a process of their own";
}

TEST(Respawned, WithoutTheOptionItRunsHere) {
  const pid_t here = getpid();
  EXPECT_EQ(respawn([&] { return getpid() == here ? 5 : 6; }, false), 5);
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
  int status = 0;
  ASSERT_EQ(waitpid(watcher, &status, 0), watcher);
  EXPECT_EQ(begun.read(), '\0') << "nobody runs on, nobody is started anew";
  EXPECT_TRUE(signal == SIGKILL || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

TEST(Respawned, AnEndThatIsAskedForEndsBoth) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) expectBothEndBy(signal);
}

}  // namespace
}  // namespace pilothouse
