#pragma once

#include <string>
#include <vector>

namespace pilothouse::bench {

/// What a benchmark's command line may say: --rounds N, --out FILE, and its own switches.
struct BenchCommand {
  std::string name;
  std::string help;                   ///< all that --help prints
  std::vector<std::string> switches;  ///< options without a value
};

struct BenchOptions {
  int rounds = 300;
  std::string out;  ///< file for JSON; empty: none
  std::vector<std::string> given;

  bool has(const std::string& option) const;
};

/// Reads the command line. --help prints and exits with 0; a fault prints one line and exits
/// with 2.
BenchOptions readOptions(const BenchCommand& command, int argc, char** argv);

/// Prints "NAME: message" and exits with 2.
[[noreturn]] void refuse(const BenchCommand& command, const std::string& message);

}  // namespace pilothouse::bench
