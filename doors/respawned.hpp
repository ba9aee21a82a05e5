#pragma once

#include <functional>

namespace pilothouse {

/// What a process returns that refuses what it is asked: started again, it would refuse again.
constexpr int kRefused = 3;

/// With --respawn among the arguments: runs `work` in a process of its own, and anew whenever that
/// ended, killed, crashed or by itself, unless it returned kRefused; else runs it here. SIGINT and
/// SIGTERM go on to it, each of them, and nothing is started after them. Who kills this process
/// ends both. Call before anything that has a thread.
/// @return what `work` returned; 0 when a signal ended it that was asked for.
int runRespawned(int argc, char** argv, const std::function<int()>& work);

}  // namespace pilothouse
