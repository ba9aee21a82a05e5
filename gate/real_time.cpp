#include "gate/real_time.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "doors/steady_clock.hpp"

namespace pilothouse {

std::string becomeRealTime() {
  std::string refused;
  sched_param priority{};
  priority.sched_priority = 20;  // before ordinary threads, after the kernel's own
  if (const int fault = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority))
    refused = std::string("SCHED_FIFO (") + std::strerror(fault) + ")";
  if (mlockall(MCL_CURRENT) != 0)
    refused += std::string(refused.empty() ? "" : ", ") + "mlockall (" + std::strerror(errno) + ")";
  return refused;
}

void SteadyPace::wait(double period) {
  using Clock = std::chrono::steady_clock;
  next_ = std::max(next_ + period, steadyNow());
  std::this_thread::sleep_until(Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(next_))));
}

}  // namespace pilothouse
