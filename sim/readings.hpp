#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/fault.hpp"
#include "sim/imu.hpp"
#include "sim/odometry.hpp"
#include "sim/robot_base.hpp"

namespace pilothouse::sim {

/// 16UC1 in millimetres, row by row; 0: no measurement. Corrupted ones may have too few pixels.
struct DepthImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> millimetres;
};

/// RGB, three bytes a pixel, row by row. Corrupted ones may have too few.
struct ColourImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// In the order of Kinematics::wheels().
struct JointReading {
  WheelStates wheels;
  std::array<double, 4> turned{};  ///< how far each wheel has rolled in all [rad]
};

/// What the sensors deliver at one tick, and what happened. Images are never changed afterwards.
struct Readings {
  double time = 0.0;  ///< simulated [s]
  std::optional<Reading<std::shared_ptr<const DepthImage>>> depth;
  std::optional<Reading<std::shared_ptr<const ColourImage>>> colour;
  std::optional<Reading<OdometryReading>> odometry;
  std::optional<Reading<ImuReading>> imu;
  std::optional<Reading<JointReading>> joints;
  /// One a ranger [m]: a distance, or +-infinity as Ranger::measure() says.
  std::vector<std::optional<Reading<double>>> ranges;
  std::vector<Contact> contacts;  ///< begun at this tick
};

}  // namespace pilothouse::sim
