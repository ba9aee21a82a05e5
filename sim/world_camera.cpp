#include "sim/world_camera.hpp"

#include <stdexcept>

#include "sim/camera_rays.hpp"
#include "sim/fast_depth_noise.hpp"
#include "sim/world_look.hpp"

namespace pilothouse::sim {
namespace {

std::vector<Eigen::AlignedBox3f> sunlightFor(const World& world) {
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const auto& box : world.sunlight) boxes.push_back(box.cast<float>());
  return boxes;
}

}  // namespace

struct WorldCamera::State {
  const World& world;
  CameraProfile profile;
  CameraRays rays;
  FastDepthNoise noise;
  CameraHits hits;
  std::vector<float> seen;                     ///< depth but where the camera is blind
  std::unique_ptr<WorldLook> look;             ///< from the first colour picture on
  const WorldScene* coloured_scene = nullptr;  ///< whose triangles `hits` has
};

WorldCamera::WorldCamera(const World& world, const CameraProfile& profile)
    : state_(new State{world,
                       profile,
                       CameraRays(profile.model, sunlightFor(world)),
                       FastDepthNoise(profile.noise),
                       {},
                       {},
                       nullptr,
                       nullptr}) {}

WorldCamera::~WorldCamera() = default;

const CameraProfile& WorldCamera::profile() const {
  return state_->profile;
}

void WorldCamera::render(const WorldScene& scene, const Eigen::Isometry3d& T_world_optical,
                         Wanted wanted) {
  State& s = *state_;
  const bool colour = wanted == Wanted::kDepthAndColour;
  s.rays.cast(scene, T_world_optical, colour, s.hits);
  s.coloured_scene = colour ? &scene : nullptr;
  const unsigned int blind = (s.profile.blind_on_glass ? CameraHits::kGlass : 0U) |
                             (s.profile.blind_in_sunlight ? CameraHits::kSunlit : 0U);
  s.seen.resize(s.hits.depth.size());
  for (std::size_t i = 0; i < s.seen.size(); ++i)
    s.seen[i] = (s.hits.flags[i] & blind) != 0 ? 0.0F : s.hits.depth[i];
}

const std::vector<float>& WorldCamera::perfectDepth() const {
  return state_->seen;
}

void WorldCamera::depth(std::uint64_t seed, std::uint64_t frame, std::uint16_t* out) const {
  state_->noise.measure(state_->seen.data(), state_->seen.size(), seed, frame, out);
}

void WorldCamera::colour(std::uint8_t* out) {
  State& s = *state_;
  if (s.coloured_scene == nullptr)
    throw std::logic_error("the last picture was rendered without colour");
  if (!s.look) s.look = std::make_unique<WorldLook>(s.world);
  s.look->paint(*s.coloured_scene, s.hits, static_cast<float>(s.profile.model.intrinsics.fx), out);
}

}  // namespace pilothouse::sim
