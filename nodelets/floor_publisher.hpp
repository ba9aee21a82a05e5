#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <mutex>
#include <string>

#include "core/floor/floor_segmenter.hpp"
#include "doors/floor_settings.hpp"
#include "nodelets/camera_mounting.hpp"
#include "nodelets/floor_outputs.hpp"
#include "nodelets/input_health.hpp"

namespace pilothouse {

/// Parameters of the floor nodelets beside FloorParameters; they hold until the next start.
struct FloorNodeParameters {
  std::string base_frame = "base_link";  ///< frame of the grid, the objects and the scan
  /// Where the camera's mounting comes from. tf: the transform at the picture's stamp. search: the
  /// floor plane of each picture itself, for recordings without tf; published on tf besides.
  std::string mounting_source = "tf";
  double input_timeout = 3.0;  ///< without input for this long: an error [s], 0.1..3600
  FloorParameters floor;
};

/// The part that the depth and the cloud nodelet share: parameters, mounting, the segmenter, the
/// outputs and their health. Parameters come from the struct's defaults, then from robot/floor (the
/// robot's own file), then from the nodelet's private names, each read strictly.
/// One frame at a time; any thread may call.
class FloorPublisher {
 public:
  /// @param input name of the input's topic, for messages.
  /// @throws ParameterFault (every fault logged as fatal): nothing was started then.
  FloorPublisher(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& input);

  /// Advertises; `demand` subscribes to the inputs and drops them.
  void start(FloorOutputs::Demand demand);

  template <class View>
  void process(const std_msgs::Header& header, const Checked<View>& view);
  /// Counts an input that did not get as far as process(). @param kind a few words to count by.
  void reject(const std::string& kind, const std::string& reason);

 private:
  void reconfigure(FloorConfig& config);
  void noticeTime(const ros::Time& stamp);
  template <class View>
  Checked<Eigen::Isometry3f> mountingOf(const std_msgs::Header& header, const View& view);
  void reportMounting(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_, private_handle_;
  FloorNodeParameters parameters_;
  InputHealth health_;
  FloorOutputs outputs_;
  /// Guards all below: frames, reconfiguring and diagnostics run on a nodelet's one queue, but
  /// onInit is another thread, and who uses this class may choose another queue.
  std::mutex mutex_;
  CameraMounting mounting_;
  tf2_ros::TransformBroadcaster broadcaster_;
  FloorSegmenter segmenter_;
  ros::Time newest_stamp_;
  std::unique_ptr<dynamic_reconfigure::Server<FloorConfig>> server_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace pilothouse
