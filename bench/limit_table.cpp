#include "bench/limit_table.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>

#include "bench/json_line.hpp"

namespace pilothouse::bench {

LimitTable::LimitTable(const BenchCommand& command, const BenchOptions& options, int decimals)
    : bench_(command.name.substr(command.name.find('_') + 1)),
      rounds_(options.rounds),
      decimals_(decimals) {
  if (options.out.empty()) return;
  out_.open(options.out);
  if (!out_) refuse(command, "cannot write " + options.out);
}

void LimitTable::measure(std::vector<TimedCase>& cases) {
  pinToOneProcessor();
  bench::measure(cases, rounds_, std::max(5, rounds_ / 20), threadSeconds);
  std::printf("%-48s %10s %10s %8s\n", "case", "median ms", "p95 ms", "of limit");
}

void LimitTable::tell(const std::string& name, double median_ms, double p95_ms,
                      const std::optional<double>& limit_ms) {
  JsonLine line;
  line.text("bench", bench_).text("case", name);
  line.number("median_ms", median_ms, decimals_).number("p95_ms", p95_ms, decimals_);
  std::printf("%-48s %10.*f %10.*f", name.c_str(), decimals_, median_ms, decimals_, p95_ms);
  if (limit_ms) {
    const double ratio = median_ms / *limit_ms;
    line.number("ratio", ratio, 3).text("of", "limit").number("limit_ms", *limit_ms, 4);
    line.truth("pass", ratio <= 1.0);
    std::printf(" %8.3f%s", ratio, ratio <= 1.0 ? "" : "  MISSED");
    kept_ = kept_ && ratio <= 1.0;
  }
  std::printf("\n");
  write(line.str());
}

void LimitTable::tellRatio(const std::string& name, double ratio, double limit,
                           const std::string& of) {
  const bool pass = ratio <= limit;
  JsonLine line;
  line.text("bench", bench_).text("case", name).number("ratio", ratio, 3).text("of", of);
  line.number("limit", limit, 2).truth("pass", pass);
  std::printf("%-70s %8.3f  of %g at most%s\n", name.c_str(), ratio, limit, pass ? "" : "  MISSED");
  write(line.str());
  kept_ = kept_ && pass;
}

int runBench(const BenchCommand& command, int argc, char** argv, int decimals,
             const std::function<void(const BenchOptions&, LimitTable&)>& run) {
  const BenchOptions options = readOptions(command, argc, argv);
  try {
    LimitTable table(command, options, decimals);
    run(options, table);
    return table.kept() ? 0 : 1;
  } catch (const std::exception& fault) {
    refuse(command, fault.what());
  }
}

}  // namespace pilothouse::bench
