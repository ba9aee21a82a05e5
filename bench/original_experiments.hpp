#pragma once

#include <string>
#include <vector>

#include "bench/drive_figure.hpp"
#include "bench/drive_record.hpp"

namespace pilothouse::bench {

/// One expectation of an experiment and what came of it.
struct Finding {
  std::string what;
  std::string expected, seen;
  bool pass = false;
};

struct Experiment {
  std::string name;  ///< of its picture
  std::vector<Finding> findings;
  RobotDescription robot;  ///< with the experiment's parameters
  DriveRecord record;
  DriveFigure figure;
  bool pass() const;
};

/// The experiments of the original (KTU master thesis, 2014), in its numbers, on the simulated
/// platform: what each expects is written where it is judged. Same seed, same results.
/// @throws std::runtime_error where a world's file is missing.
std::vector<Experiment> runOriginalExperiments(const RobotDescription& platform,
                                               std::uint64_t seed);

}  // namespace pilothouse::bench
