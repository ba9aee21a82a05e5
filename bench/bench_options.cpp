#include "bench/bench_options.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace pilothouse::bench {

bool BenchOptions::has(const std::string& option) const {
  return std::find(given.begin(), given.end(), option) != given.end();
}

void refuse(const BenchCommand& command, const std::string& message) {
  std::cerr << command.name << ": " << message << "\n";
  std::exit(2);
}

BenchOptions readOptions(const BenchCommand& command, int argc, char** argv) {
  BenchOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--help" || option == "-h") {
      std::cout << command.help;
      std::exit(0);
    }
    const auto& known = command.switches;
    if (std::find(known.begin(), known.end(), option) != known.end()) {
      options.given.push_back(option);
      continue;
    }
    if (option != "--rounds" && option != "--out")
      refuse(command, "unknown option '" + option + "'");
    if (++i >= argc) refuse(command, option + " needs a value");
    if (option == "--out") {
      options.out = argv[i];
      continue;
    }
    char* end = nullptr;
    const long rounds = std::strtol(argv[i], &end, 10);
    if (*end != '\0' || rounds < 5 || rounds > 100000) {
      refuse(command, std::string("--rounds is '") + argv[i] + "', expected 5..100000");
    }
    options.rounds = static_cast<int>(rounds);
  }
  return options;
}

}  // namespace pilothouse::bench
