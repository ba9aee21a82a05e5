#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pilothouse::bench {

/// What an evaluation's command line may say.
struct EvalOptions {
  int runs = 20;
  std::optional<int> only;  ///< of these runs one alone
  int faults = 500;
  int appearances = 200;
  std::uint64_t seed = 1;
  std::string data;  ///< folder of recordings; empty: not given
  std::string bag;   ///< a recording; empty: not given
  std::string out;   ///< folder for pictures; empty: none
};

/// Which of the options an evaluation knows, and what --help says first.
struct EvalCommand {
  std::string name;
  std::string purpose;
  std::vector<std::string>
      options;  ///< of --runs --only --faults --appearances --seed --data --bag --out
};

/// Reads the command line. --help prints and exits with 0; a fault prints one line and exits
/// with 2. Makes the folder of --out.
EvalOptions readOptions(const EvalCommand& command, int argc, char** argv);

/// A whole evaluation: what `run` returns, or 2 where it throws, with one line that says why.
int runEval(const EvalCommand& command, int argc, char** argv,
            const std::function<int(const EvalOptions&)>& run);

/// Prints "NAME: message" and exits with 2.
[[noreturn]] void refuse(const EvalCommand& command, const std::string& message);

}  // namespace pilothouse::bench
