// Every user of PCL's algorithms and OctoMap in one file: their headers take long to compile.

#include "bench/rivals.hpp"

#include <octomap/OcTree.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <cmath>

namespace pilothouse::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
constexpr float kVoxel = 0.02F;           // [m]
constexpr double kPlaneTolerance = 0.02;  // [m]
constexpr double kOctomapVoxel = 0.05;    // [m]

Cloud::Ptr voxels(const Cloud::ConstPtr& cloud) {
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(kVoxel, kVoxel, kVoxel);
  Cloud::Ptr result(new Cloud);
  grid.filter(*result);
  return result;
}

}  // namespace

struct Rivals::Impl {
  Cloud::Ptr cloud{new Cloud};
  octomap::Pointcloud octomap_cloud;
  octomap::point3d camera;
  octomap::OcTree map{kOctomapVoxel};
};

Rivals::Rivals(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& camera)
    : impl_(std::make_unique<Impl>()) {
  for (const Eigen::Vector3f& p : points) {
    impl_->cloud->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
    impl_->octomap_cloud.push_back(p.x(), p.y(), p.z());
  }
  impl_->camera = octomap::point3d(camera.x(), camera.y(), camera.z());
}
Rivals::~Rivals() = default;

std::size_t Rivals::ransacPlane() const {
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(kPlaneTolerance);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setInputCloud(voxels(impl_->cloud));
  pcl::PointIndices inliers;
  pcl::ModelCoefficients plane;
  segmentation.segment(inliers, plane);
  return inliers.indices.size();
}

std::size_t Rivals::regionGrowing() const {
  const Cloud::Ptr cloud = voxels(impl_->cloud);
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setSearchMethod(tree);
  estimation.setInputCloud(cloud);
  estimation.setKSearch(30);
  estimation.compute(*normals);
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setSearchMethod(tree);
  growing.setInputCloud(cloud);
  growing.setInputNormals(normals);
  growing.setMinClusterSize(50);
  growing.setNumberOfNeighbours(30);
  growing.setSmoothnessThreshold(static_cast<float>(3.0 * M_PI / 180.0));
  growing.setCurvatureThreshold(1.0F);
  std::vector<pcl::PointIndices> clusters;
  growing.extract(clusters);
  return clusters.size();
}

std::size_t Rivals::insertOctomap() {
  impl_->map.insertPointCloud(impl_->octomap_cloud, impl_->camera);
  return impl_->map.size();
}

}  // namespace pilothouse::bench
