#pragma once

#include <array>
#include <cstdint>

#include "sim/floor_scene.hpp"

namespace pilothouse::sim {

/// Kinds of random scene that floor finding is judged on.
enum class SceneKind : std::uint8_t {
  kEmpty,        ///< floor alone
  kBoxes7cm,     ///< 1-6 boxes 7 cm high
  kBoxes18cm,    ///< 1-6 boxes 18 cm high
  kBoxes,        ///< 1-6 boxes, 5-60 cm high
  kRamp,         ///< a ramp up of 3-10 degrees, as wide as the view or 0.8-1.6 m
  kBoxesOnRamp,  ///< an 8 degree ramp as wide as the view with 1-2 boxes on it
  kSills,        ///< 1-2 bars 0.5-2 cm high, 3-12 cm deep
  kMixed,        ///< a ramp, a sill and 1-3 boxes
  kDropOff,      ///< the floor ends at a step down of 7-20 cm
};
constexpr std::array<SceneKind, 9> kSceneKinds = {
    SceneKind::kEmpty, SceneKind::kBoxes7cm, SceneKind::kBoxes18cm,
    SceneKind::kBoxes, SceneKind::kRamp,     SceneKind::kBoxesOnRamp,
    SceneKind::kSills, SceneKind::kMixed,    SceneKind::kDropOff};
const char* nameOf(SceneKind kind);

/// A scene of the kind, in front of a camera above the base frame's origin. Same seed, same scene.
FloorScene randomScene(SceneKind kind, std::uint64_t seed);

}  // namespace pilothouse::sim
