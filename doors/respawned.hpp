#pragma once

#include <functional>

namespace pilothouse {

/// With --respawn among the arguments: runs `work` in a process of its own, and anew whenever that
/// was killed or crashed, until it returns; else runs it here. What it returns is for good: who
/// refuses a parameter would refuse it again. SIGINT and SIGTERM go on to it, and nothing is
/// started after them. Call before anything that has a thread.
/// @return what `work` returned; after a signal, 0.
int runRespawned(int argc, char** argv, const std::function<int()>& work);

}  // namespace pilothouse
