#include <octomap/OcTree.h>

#include <cmath>
#include <memory>

#include "bench/map_cases.hpp"
#include "bench/standard_frame.hpp"
#include "volume/volume_map.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kFrameMs = 8.0;  // of a core
constexpr double kVoxel = 0.05;   // [m]
constexpr int kFrames = 400;      // of the robot's round

/// A robot that goes round: what the frame shows is elsewhere each time.
struct Round {
  StandardFrame frame;
  int step = 0;
  Eigen::Isometry3d next() {
    const double t = 2.0 * M_PI * (step++ % kFrames) / kFrames;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = Eigen::Vector3d(std::cos(t), std::sin(t), 0.0);
    T.linear() = Eigen::AngleAxisd(t, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return T * frame.T_base_optical().cast<double>();
  }
};

struct OurVolume : Round {
  VolumeMap map{VolumeParameters{}};
  void add() { map.add(frame.depth(), next()); }
};

/// A robot that drives on and on, and has long forgotten where it began.
struct LongDrive {
  StandardFrame frame;
  VolumeMap map;
  int step = 0;

  LongDrive() : map(few()) {
    while (map.report().forgotten_nodes == 0) add();
  }
  static VolumeParameters few() {
    VolumeParameters parameters;
    parameters.max_nodes = 400000;
    return parameters;
  }
  void add() {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().x() = 0.15 * (step++ % 6000);
    map.add(frame.depth(), T * frame.T_base_optical().cast<double>());
  }
};

struct OctomapAsItStands : Round {
  octomap::OcTree tree{kVoxel};
  octomap::Pointcloud cloud() {
    const Eigen::Isometry3f T = next().cast<float>();
    octomap::Pointcloud points;
    points.reserve(frame.validPoints().size());
    for (const auto& p : frame.validPoints()) {
      const Eigen::Vector3f at = T * p;
      points.push_back(at.x(), at.y(), at.z());
    }
    camera = {T.translation().x(), T.translation().y(), T.translation().z()};
    return points;
  }
  void plain() { tree.insertPointCloud(cloud(), camera); }
  void discretised() { tree.insertPointCloud(cloud(), camera, 4.0, true, true); }
  octomap::point3d camera;
};

}  // namespace

void addVolumeCases(std::vector<TimedCase>& cases) {
  const auto ours = std::make_shared<OurVolume>();
  for (int i = 0; i < kFrames; ++i) ours->add();  // the room is known, as it mostly is
  const auto fresh = std::make_shared<OurVolume>();
  const auto plain = std::make_shared<OctomapAsItStands>();
  const auto discretised = std::make_shared<OctomapAsItStands>();
  for (int i = 0; i < 20; ++i) discretised->discretised();
  cases.push_back({"octree, a frame at 5 cm", [ours] { ours->add(); }, {}, false, kFrameMs});
  cases.push_back({"octree, a frame in a new place", [fresh] { fresh->add(); },
                   [fresh] {
                     if (fresh->step % 50 == 0) fresh->map.clear();
                   },
                   false, std::nullopt});
  const auto drive = std::make_shared<LongDrive>();
  cases.push_back({"octree, a frame while it forgets what is far",
                   [drive] { drive->add(); },
                   {},
                   false,
                   kFrameMs});
  cases.push_back({"octree, brought up to date and written",
                   [ours] { ours->map.encode(); },
                   {},
                   true,
                   std::nullopt});
  cases.push_back({"octree, one point a voxel, 4 m, lazy (OctoMap)",
                   [discretised] { discretised->discretised(); },
                   {},
                   true,
                   std::nullopt});
  cases.push_back(
      {"octree, plain insertion (OctoMap)", [plain] { plain->plain(); }, {}, true, std::nullopt});
}

}  // namespace pilothouse::bench
