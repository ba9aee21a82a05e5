#include "nodelets/floor_publisher.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include "core/floor/plane_search.hpp"
#include "nodelets/mounting_report.hpp"

namespace pilothouse {
namespace {

/// Stamps may be a little out of order; a bag that starts again jumps farther back than this.
constexpr double kJitter = 0.1;  // [s]

FloorNodeParameters readParameters(const ros::NodeHandle& handle,
                                   const ros::NodeHandle& private_handle) {
  FloorNodeParameters parameters;
  StrictParameters robot(ros::NodeHandle(handle, "robot/floor"));
  readFloorParameters(robot, parameters.floor);
  StrictParameters reader(private_handle);
  reader.merge(robot);
  reader.read("base_frame", parameters.base_frame);
  reader.read("mounting_source", parameters.mounting_source, {"tf", "search"});
  reader.read("input_timeout", parameters.input_timeout, 0.1, 3600.0);
  readFloorParameters(reader, parameters.floor);
  reader.finish();
  return parameters;
}

}  // namespace

FloorPublisher::FloorPublisher(ros::NodeHandle handle, ros::NodeHandle private_handle,
                               const std::string& input)
    : handle_(std::move(handle)),
      private_handle_(std::move(private_handle)),
      parameters_(readParameters(handle_, private_handle_)),
      health_(handle_.resolveName(input), parameters_.input_timeout),
      mounting_(parameters_.base_frame),
      segmenter_(parameters_.floor) {}

void FloorPublisher::start(FloorOutputs::Demand demand) {
  // The server begins with what the parameter server holds: first write there what was decided.
  toConfig(parameters_.floor).__toServer__(private_handle_);
  server_ = std::make_unique<dynamic_reconfigure::Server<FloorConfig>>(private_handle_);
  server_->setCallback([this](FloorConfig& config, std::uint32_t) { reconfigure(config); });

  diagnostics_ = std::make_unique<diagnostic_updater::Updater>(handle_, private_handle_,
                                                               private_handle_.getNamespace());
  diagnostics_->setHardwareID("none");
  diagnostics_->add("input", &health_, &InputHealth::report);
  diagnostics_->add("mounting", this, &FloorPublisher::reportMounting);
  // On the wall clock: a paused recording must not silence the diagnostics.
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });

  outputs_.advertise(handle_, [this, demand](bool wanted) {
    health_.listening(wanted);
    demand(wanted);
  });
}

void FloorPublisher::reconfigure(FloorConfig& config) {
  std::lock_guard<std::mutex> lock(mutex_);
  try {
    segmenter_.setParameters(fromConfig(config));
  } catch (const std::invalid_argument& fault) {
    ROS_WARN("%s keeps its parameters, refused: %s", private_handle_.getNamespace().c_str(),
             fault.what());
    config = toConfig(segmenter_.parameters());
  }
}

void FloorPublisher::noticeTime(const ros::Time& stamp) {
  // In double: stamps are anyone's, and ros::Time and Duration throw where a sum or difference does
  // not fit them.
  health_.stamped(ros::Time::now().toSec() - stamp.toSec());
  // By the stamps alone: the clock of a bag that starts again may jump before or after its first
  // picture, and what is remembered here comes from pictures.
  if (stamp.toSec() + kJitter < newest_stamp_.toSec()) {
    ROS_WARN("%s: time jumped back, starting afresh", private_handle_.getNamespace().c_str());
    mounting_.reset();
    segmenter_.reset();
    health_.timeJumped();
    newest_stamp_ = stamp;
  }
  newest_stamp_ = std::max(newest_stamp_, stamp);
}

void FloorPublisher::reject(const std::string& kind, const std::string& reason) {
  health_.arrived();
  health_.rejected(kind, reason);
}

template <class View>
Checked<Eigen::Isometry3f> FloorPublisher::mountingOf(const std_msgs::Header& header,
                                                      const View& view) {
  if (parameters_.mounting_source == "tf") return mounting_.find(header);
  segmenter_.reset();  // each picture stands alone: there is no mounting to compare or to average
  const Checked<FloorPlane> plane = findFloorPlane(view);
  if (!plane) return Checked<Eigen::Isometry3f>::refused(plane.reason());
  const Eigen::Isometry3f T_base_camera = mountingFromPlane(*plane);
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_base_camera.cast<double>());
  transform.header = header;
  transform.header.frame_id = parameters_.base_frame;
  transform.child_frame_id = header.frame_id;
  if (!header.frame_id.empty()) broadcaster_.sendTransform(transform);
  return Checked<Eigen::Isometry3f>::of(T_base_camera);
}

template <class View>
void FloorPublisher::process(const std_msgs::Header& header, const Checked<View>& view) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto begin = InputHealth::Clock::now();
  health_.arrived();
  noticeTime(header.stamp);
  if (!view) return health_.rejected("message", view.reason());
  const Checked<Eigen::Isometry3f> T_base_camera = mountingOf(header, *view);
  if (!T_base_camera) return health_.rejected("mounting", T_base_camera.reason());
  const FloorCells& grid = segmenter_.segment(*view, *T_base_camera);
  outputs_.publish(header, *view, parameters_.base_frame, segmenter_.mountingUsed(), grid,
                   segmenter_.parameters());
  health_.accepted(InputHealth::Clock::now() - begin);
}

template void FloorPublisher::process(const std_msgs::Header&, const Checked<CloudView>&);
template void FloorPublisher::process(const std_msgs::Header&, const Checked<DepthView>&);

void FloorPublisher::reportMounting(diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::lock_guard<std::mutex> lock(mutex_);
  status.add("source", parameters_.mounting_source);
  status.add("transforms out of time", mounting_.outOfTime());
  if (parameters_.mounting_source == "tf") {
    reportEstimate(segmenter_.mounting(), segmenter_.parameters().calibrate_mounting, status);
  } else {
    reportFound(segmenter_.mountingUsed(), status);
  }
}

}  // namespace pilothouse
