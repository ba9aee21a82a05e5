#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/depth_noise.hpp"
#include "sim/floor_scene.hpp"
#include "sim/world.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// A kind of depth camera.
struct CameraProfile {
  CameraModel model;
  DepthNoise noise;
  bool blind_on_glass = true;      ///< no depth through glass
  bool blind_in_sunlight = false;  ///< no depth in World::sunlight
};
/// kinect (640x480, 57 degrees wide), kinect_qvga (its 320x240 mode), realsense (stereo: noise
/// grows faster, works in sunlight), tof (160x120 time of flight). None: no such name.
std::optional<CameraProfile> cameraProfile(const std::string& name);
std::vector<std::string> cameraProfileNames();

/// A depth camera with colour from the same eye. render() first; depth() and colour() read what it
/// saw. Allocates on first use only.
class WorldCamera {
 public:
  /// @param world must outlive the camera.
  WorldCamera(const World& world, const CameraProfile& profile);
  ~WorldCamera();
  WorldCamera(const WorldCamera&) = delete;
  WorldCamera& operator=(const WorldCamera&) = delete;

  const CameraProfile& profile() const;
  enum class Wanted { kDepth, kDepthAndColour };
  /// One ray a pixel. @param scene of the same world, committed.
  void render(const WorldScene& scene, const Eigen::Isometry3d& T_world_optical,
              Wanted wanted = Wanted::kDepthAndColour);

  /// Perfect depth along the optical axis, row by row [m]; 0: nothing there, or (as the profile
  /// has it) glass or sunlight in the way.
  const std::vector<float>& perfectDepth() const;
  /// What the camera measures: 16UC1 [mm], row by row; 0: no measurement. Same profile, view, seed
  /// and frame: same bytes. @param out width * height values.
  void depth(std::uint64_t seed, std::uint64_t frame, std::uint16_t* out) const;
  /// RGB, three bytes a pixel, row by row, of a view rendered with colour; its scene must still be
  /// as it was. @param out 3 * width * height bytes. @throws std::logic_error without a colour
  /// view.
  void colour(std::uint8_t* out);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pilothouse::sim
