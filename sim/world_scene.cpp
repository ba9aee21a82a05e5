#include "sim/world_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "sim/world_scene_embree.hpp"

namespace pilothouse::sim {
namespace {

constexpr float kStartAbove = 1e-4F;  // so that a ray from a surface finds that surface [m]

std::uint32_t kindsOf(const Part& part) {
  std::uint32_t kinds = 0;
  if (part.visible) kinds |= kRangerRay | (part.material.glass ? kGlassRay : kCameraRay);
  if (part.solid) kinds |= kSolidRay;
  return kinds;
}

void checkDevice(RTCDevice device) {
  if (device == nullptr) {
    throw std::runtime_error("Embree does not start: error " +
                             std::to_string(rtcGetDeviceError(nullptr)));
  }
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0) {
    rtcReleaseDevice(device);
    throw std::runtime_error("this Embree was built without ray masks, which the simulator needs");
  }
}

}  // namespace

WorldScene::Embree::Embree() : device(rtcNewDevice("threads=1")) {
  checkDevice(device);
  fixed = rtcNewScene(device);
  moving = rtcNewScene(device);
  rtcSetSceneBuildQuality(fixed, RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneFlags(moving, RTC_SCENE_FLAG_DYNAMIC);
}

WorldScene::Embree::~Embree() {
  for (const Mover& mover : movers) {
    rtcReleaseGeometry(mover.instance);
    rtcReleaseScene(mover.scene);
  }
  rtcReleaseScene(moving);
  rtcReleaseScene(fixed);
  rtcReleaseDevice(device);
}

bool WorldScene::Embree::attach(RTCScene scene, const Piece& piece, unsigned int number,
                                const std::vector<Eigen::Vector3f>& vertices) {
  if (piece.kinds == 0 || piece.triangles.empty()) return false;
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* points = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Eigen::Vector3f), vertices.size());
  void* corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(piece.triangles.front()), piece.triangles.size());
  if (points == nullptr || corners == nullptr) {
    rtcReleaseGeometry(geometry);
    throw std::runtime_error("no memory for the world's triangles");
  }
  std::memcpy(points, vertices.data(), vertices.size() * sizeof(Eigen::Vector3f));
  std::memcpy(corners, piece.triangles.data(),
              piece.triangles.size() * sizeof(piece.triangles.front()));
  rtcSetGeometryMask(geometry, piece.kinds);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, number);
  rtcReleaseGeometry(geometry);
  return true;
}

void WorldScene::Embree::place(const Mover& mover, const Eigen::Isometry3d& T_world_model) {
  const Eigen::Matrix<float, 3, 4> transform = T_world_model.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(mover.instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  rtcCommitGeometry(mover.instance);
  moving_changed = true;
}

WorldScene::WorldScene(const World& world) : embree_(std::make_unique<Embree>()) {
  embree_->mover_of.assign(world.models.size(), -1);
  for (std::size_t m = 0; m < world.models.size(); ++m) {
    const Model& model = world.models[m];
    first_piece_.push_back(pieces_.size());
    poses_.push_back(model.T_world_model);
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
      const Part& part = model.parts[p];
      pieces_.push_back({m,
                         p,
                         part.solid,
                         kindsOf(part),
                         part.mesh.vertices,
                         part.mesh.vertices,
                         part.mesh.triangles,
                         {}});
      toWorld(pieces_.back());
    }
  }
  first_piece_.push_back(pieces_.size());
  embree_->in_fixed.assign(pieces_.size(), false);
  for (std::size_t m = 0; m < world.models.size(); ++m) {
    if (world.models[m].path) {
      place(m, poses_[m]);
      continue;
    }
    for (std::size_t i = first_piece_[m]; i < first_piece_[m + 1]; ++i) {
      embree_->in_fixed[i] = embree_->attach(embree_->fixed, pieces_[i],
                                             static_cast<unsigned int>(i), pieces_[i].vertices);
    }
  }
  commit();
}

WorldScene::~WorldScene() = default;

std::size_t WorldScene::modelCount() const {
  return poses_.size();
}

const Eigen::Isometry3d& WorldScene::pose(std::size_t model) const {
  return poses_.at(model);
}

void WorldScene::toWorld(Piece& piece) const {
  const Eigen::Isometry3f T_world_model = poses_[piece.model].cast<float>();
  piece.bounds.setEmpty();
  for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
    piece.vertices[i] = T_world_model * piece.in_model[i];
    piece.bounds.extend(piece.vertices[i]);
  }
}

void WorldScene::place(std::size_t model, const Eigen::Isometry3d& T_world_model) {
  poses_.at(model) = T_world_model;
  for (std::size_t i = first_piece_[model]; i < first_piece_[model + 1]; ++i) toWorld(pieces_[i]);
  int& mover = embree_->mover_of[model];
  if (mover < 0) mover = makeMover(model);
  embree_->place(embree_->movers[static_cast<std::size_t>(mover)], T_world_model);
}

int WorldScene::makeMover(std::size_t model) {
  Embree::Mover mover{model, rtcNewScene(embree_->device), nullptr};
  for (std::size_t i = first_piece_[model]; i < first_piece_[model + 1]; ++i) {
    const auto number = static_cast<unsigned int>(i);
    if (embree_->in_fixed[i]) {
      rtcDetachGeometry(embree_->fixed, number);
      embree_->in_fixed[i] = false;
      embree_->fixed_changed = true;
    }
    embree_->attach(mover.scene, pieces_[i], number, pieces_[i].in_model);
  }
  rtcCommitScene(mover.scene);
  mover.instance = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(mover.instance, mover.scene);
  rtcSetGeometryMask(mover.instance, ~0U);
  rtcAttachGeometryByID(embree_->moving, mover.instance,
                        static_cast<unsigned int>(embree_->movers.size()));
  embree_->movers.push_back(mover);
  return static_cast<int>(embree_->movers.size()) - 1;
}

void WorldScene::commit() {
  if (embree_->fixed_changed) rtcCommitScene(embree_->fixed);
  if (embree_->moving_changed) rtcCommitScene(embree_->moving);
  embree_->fixed_changed = embree_->moving_changed = false;
}

std::optional<WorldScene::Hit> WorldScene::cast(const Eigen::Vector3d& origin,
                                                const Eigen::Vector3d& direction, double farthest,
                                                std::uint32_t kinds) const {
  const Eigen::Vector3f from = origin.cast<float>(), along = direction.cast<float>();
  RTCRayHit ray{};
  ray.ray.org_x = from.x();
  ray.ray.org_y = from.y();
  ray.ray.org_z = from.z();
  ray.ray.dir_x = along.x();
  ray.ray.dir_y = along.y();
  ray.ray.dir_z = along.z();
  ray.ray.tfar = static_cast<float>(farthest);
  ray.ray.mask = kinds;
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->fixed, &context, &ray);
  if (!embree_->movers.empty()) rtcIntersect1(embree_->moving, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Piece& piece = pieces_[ray.hit.geomID];
  Eigen::Vector3f normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  if (embree_->mover_of[piece.model] >= 0) {
    normal = poses_[piece.model].linear().cast<float>() * normal;
  }
  if (normal.dot(along) > 0.0F) normal = -normal;
  return Hit{ray.ray.tfar, static_cast<std::uint32_t>(piece.model),
             static_cast<std::uint32_t>(piece.part), normal.normalized()};
}

std::optional<double> WorldScene::groundBelow(const Eigen::Vector2d& point, double from_z) const {
  const double start = from_z + static_cast<double>(kStartAbove);
  const auto hit = cast({point.x(), point.y(), start}, -Eigen::Vector3d::UnitZ(),
                        std::numeric_limits<float>::infinity(), kSolidRay);
  if (!hit) return std::nullopt;
  return start - static_cast<double>(hit->distance);
}

}  // namespace pilothouse::sim
