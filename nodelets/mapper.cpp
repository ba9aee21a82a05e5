#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_eigen/tf2_eigen.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/map_views.hpp"
#include "doors/motion_views.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/map_inputs.hpp"
#include "nodelets/map_messages.hpp"
#include "nodelets/map_services.hpp"
#include "nodelets/mapper_settings.hpp"
#include "nodelets/motion_messages.hpp"
#include "nodelets/pose_queue.hpp"
#include "nodelets/steady_loop.hpp"

namespace pilothouse {

/// Learns the map from floor_grid, objects/merged and, where asked for, scan, at the poses that tf
/// tells; publishes map, map_cells and static_objects where something changed; map/save, map/load
/// and map/clear.
class Mapper : public nodelet::Nodelet {
 public:
  ~Mapper() override {
    working_.reset();
    saving_.reset();
    if (keeper_) keeper_->saveByItself();
  }

 private:
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    settings_ = readMapperSettings(getPrivateNodeHandle());
    keeper_ = std::make_unique<MapKeeper>(settings_.keeper);
    if (!keeper_->report().fault.empty()) NODELET_ERROR("%s", keeper_->report().fault.c_str());
    queue_ = std::make_unique<PoseQueue>(settings_.map_frame, settings_.base_frame);
    grid_ = handle.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    cells_ = handle.advertise<MapGrid>("map_cells", 1, true);
    standing_ = handle.advertise<ObjectList>("static_objects", 1, true);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    diagnostics_->add("map", this, &Mapper::report);
    listen();
    services_ = std::make_unique<MapServices>(handle, *keeper_, settings_.map_frame);
    saving_ = std::make_unique<SteadyLoop>(settings_.autosave, [this] { keeper_->saveByItself(); });
    working_ = std::make_unique<SteadyLoop>(0.02, [this] { work(); });
  }

  void listen() {
    subscribe<FloorGrid>("floor_grid", 1.0);
    subscribe<ObjectList>("objects/merged", 1e9);
    subscribe<sensor_msgs::CameraInfo>("camera/depth/camera_info", 1e9);
    if (settings_.use_scan) subscribe<sensor_msgs::LaserScan>("scan", 1.0);
  }

  template <class Message>
  void subscribe(const std::string& topic, double timeout) {
    healths_.push_back(std::make_unique<InputHealth>(getNodeHandle().resolveName(topic), timeout));
    InputHealth& health = *healths_.back();
    health.listening(true);
    diagnostics_->add(topic, &health, &InputHealth::report);
    subscribers_.push_back(subscribeGuarded<Message>(
        getNodeHandle(), topic, 8,
        [this, &health](const boost::shared_ptr<const Message>& message) {
          health.arrived();
          health.stamped(ros::Time::now().toSec() - message->header.stamp.toSec());
          const std::lock_guard<std::mutex> lock(mutex_);
          noticeTime(message->header.stamp, health);
          const std::string fault = take(message, health);
          if (!fault.empty()) health.rejected("message", fault);
        },
        [&health](const std::string& reason) { health.rejected("lengths", reason); }));
  }

  /// A bag that starts over must not mix its poses with those of its end.
  void noticeTime(const ros::Time& stamp, InputHealth& health) {
    constexpr double kJump = 1.0;  // [s]
    if ((newest_ - stamp).toSec() > kJump) {
      NODELET_WARN("%s: time ran back by %.1f s; the map stays", getName().c_str(),
                   (newest_ - stamp).toSec());
      health.timeJumped();
      keeper_->timeJumped();
      queue_->clear();
      newest_ = stamp;
    }
    newest_ = std::max(newest_, stamp);
  }

  // Each puts the message to the queue, or returns why it was refused.

  std::string take(const FloorGrid::ConstPtr& grid, InputHealth& health) {
    if (grid->header.frame_id != settings_.base_frame) {
      return "a grid in another frame than " + settings_.base_frame;
    }
    const auto frame = openGrid(*grid, classes_);
    if (!frame) return frame.reason();
    queue_->add(grid->header.stamp, health, [this, grid](const Pose2& pose) {
      const auto again = openGrid(*grid, classes_);
      return keeper_->floor(*again, pose);
    });
    return {};
  }

  std::string take(const ObjectList::ConstPtr& list, InputHealth& health) {
    if (list->header.frame_id != settings_.base_frame) {
      return "objects in another frame than " + settings_.base_frame;
    }
    const auto objects = openObjects(*list);
    if (!objects) return objects.reason();
    const double stamp = list->header.stamp.toSec();
    queue_->add(list->header.stamp, health, [this, objects, stamp](const Pose2& pose) {
      return keeper_->objects(*objects, pose, stamp);
    });
    return {};
  }

  std::string take(const sensor_msgs::LaserScan::ConstPtr& message, InputHealth& health) {
    std::string fault;
    const auto T_base_scanner = mounting(message->header.frame_id, fault);
    if (!T_base_scanner) return fault;
    const auto scan = planarScanOf(*message, *T_base_scanner);
    if (!scan) return scan.reason();
    queue_->add(message->header.stamp, health,
                [this, scan, message](const Pose2& pose) { return keeper_->scan(*scan, pose); });
    return {};
  }

  std::string take(const sensor_msgs::CameraInfo::ConstPtr& info, InputHealth& health) {
    if (!sighted_) {
      std::string fault;
      const auto T_base_optical = mounting(info->header.frame_id, fault);
      if (!T_base_optical) return fault;
      const auto sight = sightOf(*info, *T_base_optical, settings_.keeper.statics.nearest);
      if (!sight) return sight.reason();
      keeper_->setSight(*sight);
      sighted_ = true;
    }
    health.accepted({});
    return {};
  }

  std::optional<Eigen::Isometry3d> mounting(const std::string& frame, std::string& fault) {
    if (!queue_->transforms().canTransform(settings_.base_frame, frame, ros::Time(0), &fault)) {
      return std::nullopt;
    }
    return tf2::transformToEigen(
        queue_->transforms().lookupTransform(settings_.base_frame, frame, ros::Time(0)));
  }

  void work() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      queue_->work();
    }
    const auto now = InputHealth::Clock::now();
    if (now >= next_publishing_) {
      next_publishing_ = now + std::chrono::duration_cast<InputHealth::Clock::duration>(
                                   std::chrono::duration<double>(1.0 / settings_.publish_rate));
      publish();
    }
    if (now < next_diagnostics_) return;
    next_diagnostics_ = now + std::chrono::seconds(1);
    diagnostics_->force_update();
  }

  void publish() {
    if (!keeper_->look(view_)) return;
    std_msgs::Header now;
    now.stamp = ros::Time::now();
    now.frame_id = settings_.map_frame;
    grid_.publish(toOccupancyGrid(now, view_.cells));
    cells_.publish(toMessage(view_.cells, settings_.map_frame, now.stamp, view_.version));
    standing_.publish(toMessage(now, "map", view_.standing));
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const auto report = keeper_->report();
    if (!report.fault.empty()) {
      status.summary(diagnostic_msgs::DiagnosticStatus::ERROR, report.fault);
    } else if (report.refused_cells > 0) {
      status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "what lies outside is not learnt");
    } else {
      status.summary(diagnostic_msgs::DiagnosticStatus::OK, "learning");
    }
    status.add("blocks of 16 x 16 cells", report.blocks);
    status.add("cells outside of the map's square", report.refused_cells);
    status.add("cells that entered as staying", report.entered);
    status.add("cells cleared as gone", report.cleared);
  }

  MapperSettings settings_;
  std::unique_ptr<MapKeeper> keeper_;
  std::mutex mutex_;  ///< guards the queue and what its frames need
  std::unique_ptr<PoseQueue> queue_;
  std::vector<CellClass> classes_;
  MapKeeper::View view_;
  ros::Time newest_;
  bool sighted_ = false;
  std::vector<std::unique_ptr<InputHealth>> healths_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<MapServices> services_;
  ros::Publisher grid_, cells_, standing_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  InputHealth::Clock::time_point next_publishing_, next_diagnostics_;
  std::unique_ptr<SteadyLoop> saving_, working_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::Mapper, nodelet::Nodelet)
