#include "bench/pipeline_run.hpp"

#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <pilothouse/FloorGrid.h>
#include "bench/camera_source.hpp"
#include "bench/own_master.hpp"
#include "core/floor/floor_segmenter.hpp"
#include "doors/message_views.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kPatience = 30.0;         // [s]
constexpr std::size_t kWarmUpFrames = 15;  // the first frames find memory to take and tf to learn

double processorSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class Condition>
void waitFor(const char* what, Condition done) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (!done()) {
    if (ros::WallTime::now() > deadline || !ros::ok()) {
      throw std::runtime_error(std::string("no ") + what + " within 30 s");
    }
    ros::WallDuration(0.01).sleep();
  }
}

/// Listens to the grid in a thread of its own.
class GridSink {
 public:
  explicit GridSink(const std::string& name_space) : spinner_(1, &queue_) {
    ros::NodeHandle handle(name_space);
    handle.setCallbackQueue(&queue_);
    subscriber_ = handle.subscribe("floor_grid", 10, &GridSink::take, this,
                                   ros::TransportHints().tcpNoDelay());
    spinner_.start();
  }
  std::vector<double> latencies() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return latencies_ms_;
  }

 private:
  void take(const FloorGrid::ConstPtr& grid) {
    const double latency = (ros::Time::now() - grid->header.stamp).toSec() * 1e3;
    const std::lock_guard<std::mutex> lock(mutex_);
    latencies_ms_.push_back(latency);
  }

  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::Subscriber subscriber_;
  mutable std::mutex mutex_;
  std::vector<double> latencies_ms_;
};

geometry_msgs::TransformStamped mountingOf(const StandardFrame& frame) {
  geometry_msgs::TransformStamped transform =
      tf2::eigenToTransform(Eigen::Isometry3d(frame.T_base_optical().cast<double>()));
  transform.header.frame_id = "base_link";
  transform.child_frame_id = kCameraFrame;
  return transform;
}

template <class View>
double timeOf(FloorSegmenter& segmenter, const View& view, const Eigen::Isometry3f& T) {
  if (!view) throw std::runtime_error(view.reason());
  const auto start = std::chrono::steady_clock::now();
  segmenter.segment(*view, T);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

std::vector<double> measureCore(bool depth, double seconds) {
  using Clock = std::chrono::steady_clock;
  const StandardFrame frame;
  const Eigen::Isometry3f& T = frame.T_base_optical();
  FloorSegmenter segmenter{FloorParameters{}};
  std::vector<double> times_ms;
  const auto start = Clock::now();
  for (int i = 0; i < static_cast<int>(seconds * kFrameRate); ++i) {
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(i / kFrameRate)));
    double time = 0.0;
    if (depth) {
      const auto image = imageOf(frame);
      time = timeOf(segmenter, openView(*image, *infoOf(frame)), T);
    } else {
      const auto cloud = cloudOf(frame);
      time = timeOf(segmenter, openView(*cloud), T);
    }
    if (static_cast<std::size_t>(i) >= kWarmUpFrames) times_ms.push_back(time);
  }
  return times_ms;
}

PipelineRun measurePipeline(bool depth, bool same_process, double seconds,
                            const std::string& program) {
  PipelineRun run;
  const std::string kind = depth ? "depth" : "cloud16";
  run.name = (same_process ? "manager/" : "tcpros/") + kind;
  const std::string name_space = "/" + (same_process ? "manager_" + kind : "tcpros_" + kind);
  tf2_ros::StaticTransformBroadcaster mounting;
  mounting.sendTransform(mountingOf(StandardFrame{}));
  nodelet::Loader loader(false);
  if (!loader.load(name_space + "/floor", depth ? "pilothouse/DepthFloor" : "pilothouse/CloudFloor",
                   ros::M_string(), nodelet::V_string())) {
    throw std::runtime_error("the floor nodelet refuses to load");
  }
  GridSink sink(name_space);
  const double processor_before = processorSeconds();
  const auto start = ros::WallTime::now();
  if (same_process) {
    CameraSource camera(ros::NodeHandle(name_space), depth);
    waitFor("listener to the camera", [&] { return camera.hasListener(); });
    run.frames_sent = camera.publishFor(seconds);
    ros::WallDuration(2.0 / kFrameRate).sleep();  // what is still on its way
  } else {
    const pid_t camera = startProcess({program, "--camera", kind, "--namespace", name_space,
                                       "--seconds", std::to_string(seconds)});
    waitFor("grid", [&] { return !sink.latencies().empty(); });
    int status = 0;
    waitpid(camera, &status, 0);
    run.frames_sent = static_cast<int>(seconds * kFrameRate);
  }
  run.processor_share =
      (processorSeconds() - processor_before) / (ros::WallTime::now() - start).toSec();
  run.latencies_ms = sink.latencies();
  if (run.latencies_ms.size() <= kWarmUpFrames) throw std::runtime_error("hardly a grid came");
  run.latencies_ms.erase(run.latencies_ms.begin(),
                         run.latencies_ms.begin() + std::ptrdiff_t{kWarmUpFrames});
  run.frames_sent -= static_cast<int>(kWarmUpFrames);
  return run;
}

int runCamera(const std::string& name_space, bool depth, double seconds) {
  CameraSource camera(ros::NodeHandle(name_space), depth);
  waitFor("listener to the camera", [&] { return camera.hasListener(); });
  camera.publishFor(seconds);
  return 0;
}

}  // namespace pilothouse::bench
