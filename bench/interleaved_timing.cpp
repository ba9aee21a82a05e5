#include "bench/interleaved_timing.hpp"

#include <sched.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "bench/json_line.hpp"

namespace pilothouse::bench {
namespace {

constexpr int kWarmUps = 3;  // one is not enough where the last cache takes only what others drop

double timed(const std::function<void()>& work, Clock clock) {
  const double start = clock();
  work();
  return 1e3 * (clock() - start);
}

}  // namespace

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void measure(std::vector<TimedCase>& cases, int rounds, int slow_rounds, Clock clock) {
  const int slow_every = std::max(1, rounds / std::max(1, slow_rounds));
  for (int round = 0; round < rounds; ++round) {
    for (TimedCase& c : cases) {
      if (c.slow && round % slow_every != 0) continue;
      if (c.before) {
        c.before();
      } else if (!c.slow) {
        for (int i = 0; i < kWarmUps; ++i) c.work();
      } else if (round == 0) {
        c.work();
      }
      c.times_ms.push_back(timed(c.work, clock));
    }
  }
}

double quantile(std::vector<double> times, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1) + 0.5);
  std::nth_element(times.begin(), times.begin() + at, times.end());
  return times[static_cast<std::size_t>(at)];
}

std::vector<std::string> report(const std::string& bench, const std::vector<TimedCase>& cases,
                                const std::string& yardstick, const std::string& out_file) {
  const auto unit =
      std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return c.name == yardstick; });
  if (unit == cases.end()) throw std::logic_error("no case " + yardstick);
  const double one = quantile(unit->times_ms, 0.5);
  std::ofstream out;
  if (!out_file.empty()) {
    out.open(out_file);
    if (!out) throw std::runtime_error("cannot write " + out_file);
  }
  std::vector<std::string> missed;
  std::printf("%-30s %10s %10s %8s %6s\n", "case", "median ms", "p95 ms", "ratio", "limit");
  for (const TimedCase& c : cases) {
    const double median = quantile(c.times_ms, 0.5);
    const double ratio = median / one;
    JsonLine line;
    line.text("bench", bench).text("case", c.name).number("median_ms", median, 4);
    line.number("p95_ms", quantile(c.times_ms, 0.95), 4).number("ratio", ratio, 3);
    line.text("of", yardstick);
    std::printf("%-30s %10.4f %10.4f %8.2f", c.name.c_str(), median, quantile(c.times_ms, 0.95),
                ratio);
    if (c.limit) {
      line.number("limit", *c.limit, 2).truth("pass", ratio <= *c.limit);
      std::printf(" %6.2f%s", *c.limit, ratio <= *c.limit ? "" : "  MISSED");
      if (ratio > *c.limit) {
        char text[160];
        std::snprintf(text, sizeof text, "%s takes %.2f x %s, limit %.2f", c.name.c_str(), ratio,
                      yardstick.c_str(), *c.limit);
        missed.emplace_back(text);
      }
    }
    std::printf("\n");
    out << line.str() << '\n';
  }
  return missed;
}

int pinToOneProcessor() {
  const int processor = sched_getcpu();
  if (processor < 0) return -1;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  return sched_setaffinity(0, sizeof set, &set) == 0 ? processor : -1;
}

}  // namespace pilothouse::bench
