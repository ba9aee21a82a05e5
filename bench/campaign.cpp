#include "bench/campaign.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

#include "doors/package_files.hpp"

namespace pilothouse::bench {

std::vector<RobotDescription> campaignRobots() {
  std::vector<RobotDescription> all;
  for (const std::string name : {"platform", "docker"}) {
    const auto robot = readRobotFile(packageFile("config/robots/" + name + ".yaml"));
    if (!robot) throw std::runtime_error(robot.reason());
    all.push_back(*robot);
  }
  RobotDescription sideways = all[0];
  sideways.name = "platform_mecanum";
  sideways.base = "omnidirectional";
  sideways.drive.kind = BaseKind::kOmnidirectional;
  all.push_back(sideways);
  return all;
}

bool tellBars(const std::vector<Bar>& bars) {
  bool all = true;
  for (const Bar& bar : bars) {
    all = all && bar.isMet();
    std::fprintf(stderr, "%-26s %10.4f   %s %g %s\n", bar.name.c_str(), bar.value,
                 bar.at_least ? ">=" : "<=", bar.limit, bar.isMet() ? "met" : "MISSED");
  }
  return all;
}

}  // namespace pilothouse::bench
