#include "bench/eval_options.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace pilothouse::bench {
namespace {

std::string describe(const std::string& option) {
  if (option == "--runs") return "  --runs N    how many (default 20)";
  if (option == "--only") return "  --only N    of these the run of that number alone, from 0";
  if (option == "--faults") return "  --faults N  how many faults (default 500)";
  if (option == "--appearances")
    return "  --appearances N  how many obstacles that appear (default 200)";
  if (option == "--seed") return "  --seed S    start of the random numbers (default 1)";
  if (option == "--data")
    return "  --data DIR  folder of recordings, searched with all its folders";
  if (option == "--bag") return "  --bag FILE  a recording";
  return "  --out DIR   draw pictures into DIR";
}

void printHelp(const EvalCommand& command) {
  std::cout << "usage: " << command.name;
  for (const auto& option : command.options) {
    const bool folder = option == "--data" || option == "--out";
    std::cout << " [" << option << (folder ? " DIR]" : option == "--bag" ? " FILE]" : " N]");
  }
  std::cout << "\n" << command.purpose << "\n";
  for (const auto& option : command.options) std::cout << describe(option) << "\n";
  std::cout << "Ends with 0 where every bar is met, 1 where one is missed, 2 on a wrong call.\n";
}

std::uint64_t readNumber(const EvalCommand& command, const std::string& option,
                         const std::string& text, std::uint64_t low, std::uint64_t high) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  try {
    const std::uint64_t value = digits ? std::stoull(text) : 0;
    if (digits && value >= low && value <= high) return value;
  } catch (const std::out_of_range&) {
    // Too long a number is refused like any other that is out of range.
  }
  refuse(command, option + " is '" + text + "', expected a whole number from " +
                      std::to_string(low) + " to " + std::to_string(high));
}

}  // namespace

void refuse(const EvalCommand& command, const std::string& message) {
  std::cerr << command.name << ": " << message << "\n";
  std::exit(2);
}

EvalOptions readOptions(const EvalCommand& command, int argc, char** argv) {
  EvalOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--help" || option == "-h") {
      printHelp(command);
      std::exit(0);
    }
    if (std::find(command.options.begin(), command.options.end(), option) ==
        command.options.end()) {
      refuse(command, "unknown option '" + option + "', --help lists them");
    }
    if (++i >= argc) refuse(command, option + " needs a value");
    const std::string value = argv[i];
    if (option == "--runs") {
      options.runs = static_cast<int>(readNumber(command, option, value, 1, 100000));
    } else if (option == "--only") {
      options.only = static_cast<int>(readNumber(command, option, value, 0, 99999));
    } else if (option == "--faults") {
      options.faults = static_cast<int>(readNumber(command, option, value, 0, 100000));
    } else if (option == "--appearances") {
      options.appearances = static_cast<int>(readNumber(command, option, value, 0, 100000));
    } else if (option == "--seed") {
      options.seed = readNumber(command, option, value, 0, ~std::uint64_t{0});
    } else if (option == "--data") {
      options.data = value;
    } else if (option == "--bag") {
      options.bag = value;
    } else {
      options.out = value;
    }
  }
  if (!options.data.empty() && !std::filesystem::is_directory(options.data)) {
    refuse(command, "--data is '" + options.data + "', expected a folder");
  }
  if (!options.bag.empty() && !std::filesystem::is_regular_file(options.bag)) {
    refuse(command, "--bag is '" + options.bag + "', expected a file");
  }
  std::error_code fault;
  if (!options.out.empty()) std::filesystem::create_directories(options.out, fault);
  if (fault) refuse(command, "--out is '" + options.out + "': " + fault.message());
  return options;
}

int runEval(const EvalCommand& command, int argc, char** argv,
            const std::function<int(const EvalOptions&)>& run) {
  const EvalOptions options = readOptions(command, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& fault) {
    refuse(command, fault.what());
  }
}

}  // namespace pilothouse::bench
