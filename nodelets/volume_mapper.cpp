#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <pilothouse/MapFile.h>
#include <std_srvs/Trigger.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/strict_parameters.hpp"
#include "nodelets/camera_info_pairing.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/steady_loop.hpp"
#include "nodelets/usual_folder.hpp"
#include "nodelets/volume_keeper.hpp"

namespace pilothouse {

/// The map in three dimensions: takes the newest camera/depth/image_rect a few times a second in a
/// thread of its own, at the pose that tf tells, and publishes volume (cubes for rviz) and
/// volume_points; volume/save, volume/load, volume/clear.
class VolumeMapper : public nodelet::Nodelet {
  using Image = sensor_msgs::Image;
  using Info = sensor_msgs::CameraInfo;

 public:
  ~VolumeMapper() override { working_.reset(); }

 private:
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    readParameters();
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
    working_ = std::make_unique<SteadyLoop>(1.0 / rate_, [this] { work(); });
  }

  void readParameters() {
    VolumeParameters parameters;
    std::string folder = usualMapFolder();
    StrictParameters own(getPrivateNodeHandle());
    own.read("map_frame", map_frame_);
    own.read("folder", folder);
    own.read("rate", rate_, 0.1, 30.0);
    own.read("publish_period", publish_period_, 0.2, 60.0);
    own.read("most_shown", most_shown_, 1, 1000000);
    forEachVolumeParameter(parameters, [&own](const char* key, auto& value, auto low, auto high) {
      own.read(key, value, low, high);
    });
    if (own.faultCount() == 0) {
      for (const auto& fault : validate(parameters)) own.addFault(fault);
    }
    own.finish();
    keeper_ = std::make_unique<VolumeKeeper>(parameters, folder);
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
                                 std::chrono::duration<double>(publish_period_));
    publish();
  }

  void learn(const Image& image, const Info& info) {
    const auto begin = InputHealth::Clock::now();
    std::string fault;
    // Waits for the pose, which comes a little after the picture; nobody else waits here.
    if (!transforms_.canTransform(map_frame_, image.header.frame_id, image.header.stamp,
                                  ros::Duration(0.2), &fault)) {
      return health_->rejected(
          "pose", "the camera's pose in " + map_frame_ + " is not known at its stamp: " + fault);
    }
    try {
      const Eigen::Isometry3d T_map_optical = tf2::transformToEigen(
          transforms_.lookupTransform(map_frame_, image.header.frame_id, image.header.stamp));
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
    header.frame_id = map_frame_;
    const auto most = static_cast<std::size_t>(most_shown_);
    if (cubes_.getNumSubscribers() > 0) cubes_.publish(keeper_->cubes(header, most));
    points_.publish(keeper_->points(header, most));
  }

  void serve() {
    ros::NodeHandle& many = getMTNodeHandle();
    const auto offer = [&](const char* name, auto work) {
      services_.push_back(many.advertiseService<MapFile::Request, MapFile::Response>(
          name, [work](MapFile::Request& request, MapFile::Response& response) {
            try {
              response.message = work(request.name);
              response.success = true;
            } catch (const std::runtime_error& fault) {
              response.message = fault.what();
            }
            return true;
          }));
    };
    offer("volume/save", [this](const std::string& name) { return keeper_->save(name); });
    offer("volume/load", [this](const std::string& name) { return keeper_->load(name); });
    using Trigger = std_srvs::Trigger;
    services_.push_back(many.advertiseService<Trigger::Request, Trigger::Response>(
        "volume/clear", [this](Trigger::Request&, Trigger::Response& response) {
          keeper_->clear();
          response.success = true;
          return true;
        }));
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const auto report = keeper_->report();
    if (report.refused_voxels > 0) {
      status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "the octree is full of what is near");
    } else {
      status.summary(diagnostic_msgs::DiagnosticStatus::OK, "learning");
    }
    status.add("nodes", report.nodes);
    status.add("memory [MB]", static_cast<double>(report.bytes) / 1e6);
    status.add("nodes forgotten as the farthest", report.forgotten_nodes);
    status.add("voxels that did not enter", report.refused_voxels);
  }

  std::string map_frame_ = "map";
  double rate_ = 3.0;            ///< pictures that are taken [Hz], 0.1..30
  double publish_period_ = 1.0;  ///< [s], 0.2..60
  int most_shown_ = 100000;      ///< voxels that are published, 1..1000000
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
  std::vector<ros::ServiceServer> services_;
  ros::Publisher cubes_, points_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  InputHealth::Clock::time_point next_diagnostics_, next_publishing_;
  std::unique_ptr<SteadyLoop> working_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::VolumeMapper, nodelet::Nodelet)
