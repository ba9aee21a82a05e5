#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "nodelets/camera_info_pairing.hpp"
#include "nodelets/file_service.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/service_thread.hpp"
#include "nodelets/steady_loop.hpp"
#include "nodelets/volume_mapper_settings.hpp"

namespace pilothouse {

/// The map in three dimensions: takes the newest camera/depth/image_rect a few times a second in a
/// thread of its own, at the pose that tf tells, and publishes volume (cubes for rviz) and
/// volume_points; volume/save, volume/load, volume/clear.
class VolumeMapper : public nodelet::Nodelet {
  using Image = sensor_msgs::Image;
  using Info = sensor_msgs::CameraInfo;

 public:
  ~VolumeMapper() override {
    working_.reset();
    saving_.reset();
    if (keeper_) keeper_->saveByItself();
  }

 private:
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    settings_ = readVolumeMapperSettings(getPrivateNodeHandle());
    keeper_ = std::make_unique<VolumeKeeper>(settings_.keeper);
    if (!keeper_->fault().empty()) NODELET_ERROR("%s", keeper_->fault().c_str());
    cubes_ = handle.advertise<visualization_msgs::Marker>("volume", 1, true);
    points_ = handle.advertise<sensor_msgs::PointCloud2>("volume_points", 1, true);
    health_ = std::make_unique<InputHealth>(handle.resolveName("camera/depth/image_rect"), 1.0);
    health_->listening(true);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    diagnostics_->add("input", health_.get(), &InputHealth::report);
    diagnostics_->add("octree", this, &VolumeMapper::report);
    const auto refused = [this](const std::string& reason) {
      health_->rejected("lengths", reason);
    };
    info_ = subscribeGuarded<Info>(
        handle, "camera/depth/camera_info", 8,
        [this](const Info::ConstPtr& info) { pairing_.add(info); }, refused);
    image_ = subscribeGuarded<Image>(
        handle, "camera/depth/image_rect", 1,
        [this](const Image::ConstPtr& image) { pairing_.add(image); }, refused);
    serve();
    saving_ = std::make_unique<SteadyLoop>(settings_.autosave, [this] { keeper_->saveByItself(); });
    working_ = std::make_unique<SteadyLoop>(1.0 / settings_.rate, [this] { work(); });
  }

  /// Keeps the newest pair; the thread takes it when its turn comes.
  void keep(const Image::ConstPtr& image, const Info::ConstPtr& info) {
    health_->arrived();
    health_->stamped((ros::Time::now() - image->header.stamp).toSec());
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_image_ = image;
    newest_info_ = info;
  }

  void work() {
    Image::ConstPtr image;
    Info::ConstPtr info;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      image.swap(newest_image_);
      info.swap(newest_info_);
    }
    if (image) learn(*image, *info);
    const auto now = InputHealth::Clock::now();
    if (now >= next_diagnostics_) {
      next_diagnostics_ = now + std::chrono::seconds(1);
      diagnostics_->force_update();
    }
    if (now < next_publishing_) return;
    next_publishing_ = now + std::chrono::duration_cast<InputHealth::Clock::duration>(
                                 std::chrono::duration<double>(settings_.publish_period));
    publish();
  }

  void learn(const Image& image, const Info& info) {
    const auto begin = InputHealth::Clock::now();
    std::string fault;
    // Waits for the pose, which comes a little after the picture; nobody else waits here.
    if (!transforms_.canTransform(settings_.map_frame, image.header.frame_id, image.header.stamp,
                                  ros::Duration(0.2), &fault)) {
      return health_->rejected("pose", "the camera's pose in " + settings_.map_frame +
                                           " is not known at its stamp: " + fault);
    }
    try {
      const Eigen::Isometry3d T_map_optical = tf2::transformToEigen(transforms_.lookupTransform(
          settings_.map_frame, image.header.frame_id, image.header.stamp));
      fault = keeper_->add(image, info, T_map_optical);
    } catch (const tf2::TransformException& error) {
      fault = error.what();
    }
    if (!fault.empty()) return health_->rejected("message", fault);
    health_->accepted(InputHealth::Clock::now() - begin);
  }

  void publish() {
    const auto report = keeper_->report();
    if (report.changes == published_changes_ && report.nodes == published_nodes_) return;
    published_changes_ = report.changes;
    published_nodes_ = report.nodes;
    std_msgs::Header header;
    header.stamp = ros::Time::now();
    header.frame_id = settings_.map_frame;
    const auto most = static_cast<std::size_t>(settings_.most_shown);
    if (cubes_.getNumSubscribers() > 0) cubes_.publish(keeper_->cubes(header, most));
    points_.publish(keeper_->points(header, most));
  }

  void serve() {
    services_ = std::make_unique<ServiceThread>(getNodeHandle());
    ros::NodeHandle& own = services_->handle();
    services_->keep(offerFile(own, "volume/save",
                              [this](const std::string& name) { return keeper_->save(name); }));
    services_->keep(offerFile(own, "volume/load",
                              [this](const std::string& name) { return keeper_->load(name); }));
    services_->keep(offerTrigger(own, "volume/clear", [this] {
      keeper_->clear();
      return std::string("the octree is empty; its files are as they were");
    }));
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const auto report = keeper_->report();
    const std::string fault = keeper_->fault();
    if (!fault.empty()) {
      status.summary(diagnostic_msgs::DiagnosticStatus::ERROR, fault);
    } else if (report.refused_voxels > 0) {
      status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "the octree is full of what is near");
    } else {
      status.summary(diagnostic_msgs::DiagnosticStatus::OK, "learning");
    }
    status.add("nodes", report.nodes);
    status.add("memory [MB]", static_cast<double>(report.bytes) / 1e6);
    status.add("nodes forgotten as the farthest", report.forgotten_nodes);
    status.add("voxels that did not enter", report.refused_voxels);
  }

  VolumeMapperSettings settings_;
  std::unique_ptr<VolumeKeeper> keeper_;
  CameraInfoPairing pairing_{
      [this](const Image::ConstPtr& image, const Info::ConstPtr& info) { keep(image, info); },
      [this](const Image::ConstPtr&) {
        health_->rejected("no camera info", "no CameraInfo that fits the picture");
      }};
  std::mutex mutex_;  ///< guards the newest pair
  Image::ConstPtr newest_image_;
  Info::ConstPtr newest_info_;
  std::uint64_t published_changes_ = 0;
  std::size_t published_nodes_ = 0;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
  std::unique_ptr<InputHealth> health_;
  ros::Subscriber image_, info_;
  std::unique_ptr<ServiceThread> services_;
  ros::Publisher cubes_, points_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  InputHealth::Clock::time_point next_diagnostics_, next_publishing_;
  std::unique_ptr<SteadyLoop> saving_, working_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::VolumeMapper, nodelet::Nodelet)
