#include "bench/floor_plane_list.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>

namespace pilothouse::bench {

Checked<std::vector<KnownPlane>> readKnownPlanes(const std::string& path) {
  using Result = Checked<std::vector<KnownPlane>>;
  std::ifstream file(path);
  if (!file) return Result::refused("cannot read '" + path + "'");
  std::vector<KnownPlane> planes;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    char name[512];
    double x = 0.0, y = 0.0, z = 0.0, height = 0.0, tilt = 0.0;
    const int found = std::sscanf(line.c_str(), "%511s n=(%lf %lf %lf) h=%lf tilt=%lf", name, &x,
                                  &y, &z, &height, &tilt);
    const Eigen::Vector3d normal(x, y, z);
    if (found != 6 || !(std::abs(normal.norm() - 1.0) < 0.01)) {
      return Result::refused(path + " line " + std::to_string(number) + " is '" + line +
                             "', expected FILE n=(X Y Z) h=H tilt=T with a unit n");
    }
    planes.push_back({name, normal.normalized(), height, tilt});
  }
  if (planes.empty()) return Result::refused(path + " lists no plane");
  return Result::of(std::move(planes));
}

}  // namespace pilothouse::bench
