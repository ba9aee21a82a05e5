#include "bench/stop_world.hpp"

namespace pilothouse::bench {

std::string stopWorld() {
  return R"(<?xml version="1.0"?>
<sdf version="1.9" xmlns:pilothouse="https://pilothouse.invalid/sdf">
  <world name="stop">
    <pilothouse:start>0 -3.2 0</pilothouse:start>
    <model name="floor">
      <static>true</static>
      <link name="link"><visual name="shape">
        <geometry><plane><normal>0 0 1</normal><size>16 16</size></plane></geometry>
        <material><pilothouse:texture>wood</pilothouse:texture></material>
      </visual></link>
    </model>
    <model name="obstacle">
      <static>true</static>
      <pose>6.5 6.5 0 0 0 0</pose>
      <link name="link"><visual name="shape">
        <pose>0 0 0.5 0 0 0</pose>
        <geometry><box><size>0.4 0.4 1.0</size></box></geometry>
        <material><diffuse>0.8 0.3 0.2 1</diffuse></material>
      </visual></link>
    </model>
  </world>
</sdf>
)";
}

}  // namespace pilothouse::bench
