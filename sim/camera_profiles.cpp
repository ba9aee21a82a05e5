#include "sim/world_camera.hpp"

namespace pilothouse::sim {
namespace {

CameraModel pinhole(std::uint32_t width, std::uint32_t height, double focal_length) {
  return {width, height, {focal_length, focal_length, (width - 1) / 2.0, (height - 1) / 2.0}};
}

struct Named {
  const char* name;
  CameraProfile profile;
};

std::vector<Named> makeProfiles() {
  CameraProfile kinect{pinhole(640, 480, 525.0), DepthNoise{}, true, true};

  CameraProfile kinect_qvga = kinect;
  kinect_qvga.model = pinhole(320, 240, 262.5);

  // Intel D435: 50 mm between its eyes, less resolved disparity, its own light is not needed.
  CameraProfile realsense{pinhole(640, 480, 385.0), DepthNoise{}, true, false};
  realsense.noise.slope = 0.006;
  realsense.noise.focal_baseline = 385.0 * 0.050;
  realsense.noise.disparity_steps = 32.0;
  realsense.noise.nearest = 0.28;

  // Time of flight: the error grows with the light that is lost, nothing is rounded.
  CameraProfile tof{pinhole(160, 120, 131.25), DepthNoise{}, true, false};
  tof.noise.floor = 0.004;
  tof.noise.slope = 0.0012;
  tof.noise.start = 0.0;
  tof.noise.disparity_steps = 0.0;
  tof.noise.nearest = 0.3;
  tof.noise.farthest = 6.0;
  return {{"kinect", kinect}, {"kinect_qvga", kinect_qvga}, {"realsense", realsense}, {"tof", tof}};
}

const std::vector<Named>& profiles() {
  static const std::vector<Named> list = makeProfiles();
  return list;
}

}  // namespace

std::optional<CameraProfile> cameraProfile(const std::string& name) {
  for (const Named& named : profiles())
    if (name == named.name) return named.profile;
  return std::nullopt;
}

std::vector<std::string> cameraProfileNames() {
  std::vector<std::string> names;
  for (const Named& named : profiles()) names.push_back(named.name);
  return names;
}

}  // namespace pilothouse::sim
