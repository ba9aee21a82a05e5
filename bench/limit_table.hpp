#pragma once

#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_options.hpp"
#include "bench/interleaved_timing.hpp"

namespace pilothouse::bench {

/// A benchmark's figures beside their limits: printed as a table, and written as JSON lines.
class LimitTable {
 public:
  /// Opens the options' file. @param decimals of the times [ms].
  LimitTable(const BenchCommand& command, const BenchOptions& options, int decimals);

  /// Times the cases on one processor, as time of that alone, the slow ones in a twentieth of the
  /// rounds, and prints the table's head. A case's limit is in milliseconds.
  void measure(std::vector<TimedCase>& cases);
  void tell(const std::string& name, double median_ms, double p95_ms,
            const std::optional<double>& limit_ms);
  /// A ratio of figures told before. @param of what it is to.
  void tellRatio(const std::string& name, double ratio, double limit, const std::string& of);
  /// Whether every limit told so far is.
  bool kept() const { return kept_; }

 private:
  void write(const std::string& line) { out_ << line << '\n'; }

  std::string bench_;
  int rounds_, decimals_;
  std::ofstream out_;
  bool kept_ = true;
};

/// The program: reads the command line, runs, and @return its exit code: 1 where a limit is missed.
int runBench(const BenchCommand& command, int argc, char** argv, int decimals,
             const std::function<void(const BenchOptions&, LimitTable&)>& run);

}  // namespace pilothouse::bench
