#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "test/own_folder.hpp"

namespace pilothouse {

/// A box that stands in a simulated world.
struct WorldBox {
  std::string name;
  double x, y, z, turn;          ///< of its middle [m, rad]
  double length, width, height;  ///< [m]
};

/// Writes a world of a floor of 20 x 20 m and these boxes. @return its file.
inline std::string writeBoxWorld(const std::string& name, std::vector<WorldBox> boxes) {
  boxes.insert(boxes.begin(), {"floor", 0.0, 0.0, -0.5, 0.0, 20.0, 20.0, 1.0});
  std::ostringstream world;
  world << "<?xml version='1.0'?><sdf version='1.9'><world name='test'>";
  for (const WorldBox& box : boxes) {
    std::ostringstream geometry;
    geometry << "<geometry><box><size>" << box.length << " " << box.width << " " << box.height
             << "</size></box></geometry>";
    world << "<model name='" << box.name << "'><static>true</static><pose>" << box.x << " " << box.y
          << " " << box.z << " 0 0 " << box.turn << "</pose><link name='l'><collision name='c'>"
          << geometry.str() << "</collision><visual name='v'>" << geometry.str()
          << "</visual></link></model>";
  }
  world << "</world></sdf>";
  const std::string path = ownFolder() + "/" + name + ".sdf";
  std::ofstream(path) << world.str();
  return path;
}

}  // namespace pilothouse
