#include "sim/camera_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/world_scene_embree.hpp"

namespace pilothouse::sim {
namespace {

constexpr float kFarthest = 200.0F;  // nothing is drawn beyond [m]
constexpr double kNear = 0.02;       // what is nearer or behind is cut off [m]

// Embree's packets by their size.
template <int kRays>
struct Packet;
template <>
struct Packet<4> {
  using RayHit = RTCRayHit4;
  static constexpr int kColumns = 4, kRows = 1;
  static constexpr auto intersect = rtcIntersect4;
};
template <>
struct Packet<8> {
  using RayHit = RTCRayHit8;
  static constexpr int kColumns = 4, kRows = 2;
  static constexpr auto intersect = rtcIntersect8;
};
template <>
struct Packet<16> {
  using RayHit = RTCRayHit16;
  static constexpr int kColumns = 4, kRows = 4;
  static constexpr auto intersect = rtcIntersect16;
};

int widestPacket(RTCDevice device) {
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) return 16;
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0) return 8;
  return 4;
}

}  // namespace

CameraRays::CameraRays(const CameraModel& camera, std::vector<Eigen::AlignedBox3f> sunlight)
    : camera_(camera), sunlight_(std::move(sunlight)) {
  const Intrinsics& k = camera.intrinsics;
  // Packets may reach over the edge: those rays are cast nowhere.
  for (std::uint32_t u = 0; u < camera.width + 4; ++u)
    column_x_.push_back(static_cast<float>((u - k.cx) / k.fx));
  for (std::uint32_t v = 0; v < camera.height + 4; ++v)
    row_y_.push_back(static_cast<float>((v - k.cy) / k.fy));
}

CameraRays::PixelBox CameraRays::pixelsOf(const Eigen::AlignedBox3f& bounds) const {
  const int width = static_cast<int>(camera_.width), height = static_cast<int>(camera_.height);
  const Intrinsics& k = camera_.intrinsics;
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto corner = bounds.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
    corners[i] = (R_world_optical_.transpose() * (corner - eye_)).cast<double>();
  }
  Eigen::AlignedBox2d pixels;
  const auto extend = [&](const Eigen::Vector3d& p) {
    pixels.extend(Eigen::Vector2d(k.cx + k.fx * p.x() / p.z(), k.cy + k.fy * p.y() / p.z()));
  };
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d& a = corners[i];
    if (a.z() >= kNear) extend(a);
    // Corners whose numbers differ in one bit share an edge: where it comes from behind.
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      const Eigen::Vector3d& b = corners[i ^ bit];
      if (a.z() >= kNear && b.z() < kNear) extend(a + (kNear - a.z()) / (b.z() - a.z()) * (b - a));
    }
  }
  if (pixels.isEmpty()) return {0, 0, 0, 0};
  const auto clamped = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  return {clamped(std::floor(pixels.min().x()), width),
          clamped(std::floor(pixels.min().y()), height),
          clamped(std::ceil(pixels.max().x()) + 1.0, width),
          clamped(std::ceil(pixels.max().y()) + 1.0, height)};
}

bool CameraRays::touches(const std::vector<PixelBox>& boxes, int u, int v, int columns, int rows) {
  for (const PixelBox& box : boxes) {
    if (u < box.u_high && u + columns > box.u_low && v < box.v_high && v + rows > box.v_low)
      return true;
  }
  return false;
}

/// Finds where in the picture the few things may be that need more than the first ray.
void CameraRays::findBoxes(const WorldScene& scene) {
  moving_.clear();
  glass_.clear();
  sunlit_.clear();
  first_triangle_.clear();
  std::uint32_t count = 0;
  for (const WorldScene::Piece& piece : scene.pieces_) {
    first_triangle_.push_back(count);
    count += static_cast<std::uint32_t>(piece.triangles.size());
  }
  for (std::size_t m = 0; m < scene.modelCount(); ++m) {
    Eigen::AlignedBox3f opaque, glass;
    for (std::size_t i = scene.first_piece_[m]; i < scene.first_piece_[m + 1]; ++i) {
      const WorldScene::Piece& piece = scene.pieces_[i];
      if (piece.kinds & kCameraRay) opaque.extend(piece.bounds);
      if (piece.kinds & kGlassRay) glass.extend(piece.bounds);
    }
    if (scene.embree_->mover_of[m] >= 0 && !opaque.isEmpty()) moving_.push_back(pixelsOf(opaque));
    if (!glass.isEmpty()) glass_.push_back(pixelsOf(glass));
  }
  for (const auto& box : sunlight_) sunlit_.push_back(pixelsOf(box));
}

template <int kRays>
void CameraRays::castPackets(const WorldScene& scene, bool triangles, CameraHits& hits) {
  using P = Packet<kRays>;
  constexpr int kColumns = P::kColumns, kRows = P::kRows;
  const int width = static_cast<int>(camera_.width), height = static_cast<int>(camera_.height);
  const Eigen::Vector3f right = R_world_optical_.col(0), down = R_world_optical_.col(1),
                        ahead = R_world_optical_.col(2);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) int valid[kRays];
  typename P::RayHit packet{};
  auto& ray = packet.ray;
  auto& hit = packet.hit;
  for (int i = 0; i < kRays; ++i) {
    ray.org_x[i] = eye_.x();
    ray.org_y[i] = eye_.y();
    ray.org_z[i] = eye_.z();
  }
  for (int v = 0; v < height; v += kRows) {
    for (int u = 0; u < width; u += kColumns) {
      for (int i = 0; i < kRays; ++i) {
        const float x = column_x_[static_cast<std::size_t>(u + i % kColumns)];
        const float y = row_y_[static_cast<std::size_t>(v + i / kColumns)];
        ray.dir_x[i] = ahead.x() + right.x() * x + down.x() * y;
        ray.dir_y[i] = ahead.y() + right.y() * x + down.y() * y;
        ray.dir_z[i] = ahead.z() + right.z() * x + down.z() * y;
        ray.tnear[i] = 0.0F;
        ray.tfar[i] = kFarthest;
        ray.mask[i] = kCameraRay;
        hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        const bool inside = u + i % kColumns < width && v + i / kColumns < height;
        valid[i] = inside ? -1 : 0;
      }
      P::intersect(valid, scene.embree_->fixed, &context, &packet);
      if (touches(moving_, u, v, kColumns, kRows))
        P::intersect(valid, scene.embree_->moving, &context, &packet);
      std::uint8_t flags[kRays] = {};
      if (touches(sunlit_, u, v, kColumns, kRows)) {
        for (int i = 0; i < kRays; ++i) {
          const Eigen::Vector3f p =
              eye_ + ray.tfar[i] * Eigen::Vector3f(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]);
          for (const auto& box : sunlight_)
            if (box.contains(p)) flags[i] |= CameraHits::kSunlit;
        }
      }
      if (touches(glass_, u, v, kColumns, kRows)) {
        // Not rtcOccluded16: Embree 3.13 does not come back from it for rays that are already
        // occluded.
        typename P::RayHit glass = packet;
        for (int i = 0; i < kRays; ++i) {
          glass.ray.mask[i] = kGlassRay;
          glass.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        P::intersect(valid, scene.embree_->fixed, &context, &glass);
        P::intersect(valid, scene.embree_->moving, &context, &glass);
        for (int i = 0; i < kRays; ++i)
          if (glass.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) flags[i] |= CameraHits::kGlass;
      }
      for (int row = 0; row < kRows && v + row < height; ++row) {
        const auto at = static_cast<std::size_t>((v + row) * width + u);
        const int columns = std::min(kColumns, width - u);
        for (int column = 0; column < columns; ++column) {
          const int i = row * kColumns + column;
          const auto pixel = at + static_cast<std::size_t>(column);
          const bool met = hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
          hits.depth[pixel] = met ? ray.tfar[i] : 0.0F;
          hits.flags[pixel] = flags[i];
          if (!triangles) continue;
          hits.triangle[pixel] =
              met ? first_triangle_[hit.geomID[i]] + hit.primID[i] : CameraHits::kNothing;
          hits.place[pixel] = static_cast<std::uint32_t>(static_cast<int>(hit.u[i] * 65535.0F)) |
                              static_cast<std::uint32_t>(static_cast<int>(hit.v[i] * 65535.0F))
                                  << 16U;
        }
      }
    }
  }
}

void CameraRays::cast(const WorldScene& scene, const Eigen::Isometry3d& T_world_optical,
                      bool triangles, CameraHits& hits) {
  const std::size_t pixels = std::size_t{camera_.width} * camera_.height;
  hits.depth.resize(pixels);
  hits.flags.resize(pixels);
  if (triangles) {
    hits.triangle.resize(pixels);
    hits.place.resize(pixels);
  }
  R_world_optical_ = T_world_optical.linear().cast<float>();
  eye_ = T_world_optical.translation().cast<float>();
  findBoxes(scene);
  const int rays = packet_ > 0 ? packet_ : widestPacket(scene.embree_->device);
  if (rays == 16) return castPackets<16>(scene, triangles, hits);
  if (rays == 8) return castPackets<8>(scene, triangles, hits);
  castPackets<4>(scene, triangles, hits);
}

}  // namespace pilothouse::sim
