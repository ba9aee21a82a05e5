#include "bench/pose_bag.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "doors/scan_views.hpp"

namespace pilothouse::bench {
namespace {

std::string bare(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

Pose2 planar(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return {pose.position.x, pose.position.y,
          std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))};
}

Pose2 planar(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.orientation = transform.rotation;
  return planar(pose);
}

/// Reads the bag twice: first its frames and who sends what, then the way.
class Reader {
 public:
  explicit Reader(const std::string& path) : bag_(path) {}

  Checked<PoseRecording> read() {
    survey();
    if (const std::string fault = chooseFrames(); !fault.empty()) {
      return Checked<PoseRecording>::refused(fault);
    }
    for (const rosbag::MessageInstance& entry : rosbag::View(bag_)) take(entry);
    if (!odometries_) return Checked<PoseRecording>::refused("no odometry that is finite");
    closeNotes();
    std::sort(recording_.reference.begin(), recording_.reference.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return Checked<PoseRecording>::of(std::move(recording_));
  }

 private:
  struct Scanner {
    std::size_t index = 0;
    std::string frame;
    std::size_t scans = 0, refused = 0, tilted = 0, lost = 0;
    std::vector<double> ahead;  ///< how long after its stamp it arrived, less its duration [s]
    bool stamped_at_end = false;
    std::string reason;
  };

  void survey() {
    for (const rosbag::MessageInstance& entry : rosbag::View(bag_)) {
      if (const auto tf = entry.instantiate<tf2_msgs::TFMessage>()) {
        for (auto transform : tf->transforms) {
          transform.header.frame_id = bare(transform.header.frame_id);
          transform.child_frame_id = bare(transform.child_frame_id);
          parents_[transform.child_frame_id] = transform.header.frame_id;
          frames_.setTransform(transform, "bag", entry.getTopic() == "/tf_static");
        }
      } else if (const auto scan = entry.instantiate<sensor_msgs::LaserScan>()) {
        Scanner& scanner = scanners_[entry.getTopic()];
        scanner.frame = bare(scan->header.frame_id);
        const double duration =
            static_cast<double>(scan->time_increment) * static_cast<double>(scan->ranges.size());
        scanner.ahead.push_back((entry.getTime() - scan->header.stamp).toSec() - duration);
      } else if (entry.isType<nav_msgs::Odometry>()) {
        ++odometry_topics_[entry.getTopic()];
      }
    }
  }

  std::string chooseFrames() {
    if (scanners_.empty()) return "it has no sensor_msgs/LaserScan: nothing to correct odometry by";
    for (auto& [topic, scanner] : scanners_) {
      scanner.index = recording_.scan_names.size();
      recording_.scan_names.push_back(topic);
      // No beam can arrive before it was measured: such a stamp is the end's, not the begin's.
      std::nth_element(
          scanner.ahead.begin(),
          scanner.ahead.begin() + static_cast<std::ptrdiff_t>(scanner.ahead.size() / 2),
          scanner.ahead.end());
      const double median = scanner.ahead[scanner.ahead.size() / 2];
      scanner.stamped_at_end = median < 0.0 && median > -1.0;
      for (std::string frame = scanner.frame; base_.empty() && parents_.count(frame);) {
        const std::string parent = parents_[frame];
        if (parent.find("odom") != std::string::npos) base_ = frame, odom_ = parent;
        frame = parent;
      }
    }
    if (!base_.empty()) {
      recording_.odometry = "tf " + odom_ + " -> " + base_;
      return {};
    }
    for (const auto& [topic, count] : odometry_topics_) {
      if (count > odometry_topics_[odometry_topic_]) odometry_topic_ = topic;
    }
    if (odometry_topic_.empty()) {
      return "it has scans but no odometry: neither tf from a frame named like odom to the scanner "
             "nor nav_msgs/Odometry";
    }
    recording_.odometry = odometry_topic_;
    return {};
  }

  void take(const rosbag::MessageInstance& entry) {
    if (const auto tf = entry.instantiate<tf2_msgs::TFMessage>()) {
      for (const auto& transform : tf->transforms) {
        if (bare(transform.child_frame_id) != base_ || base_.empty()) continue;
        addOdometry(transform.header.stamp.toSec(), planar(transform.transform));
      }
    } else if (const auto scan = entry.instantiate<sensor_msgs::LaserScan>()) {
      addScan(scanners_[entry.getTopic()], *scan);
    } else if (const auto imu = entry.instantiate<sensor_msgs::Imu>()) {
      recording_.gyro = entry.getTopic();
      recording_.events.push_back(GyroEvent{imu->header.stamp.toSec(), imu->angular_velocity.z});
    } else if (entry.getTopic().find("ground_truth") != std::string::npos) {
      addReference(entry);
    } else if (const auto odometry = entry.instantiate<nav_msgs::Odometry>()) {
      if (entry.getTopic() != odometry_topic_) return;
      if (base_in_odometry_.empty()) base_in_odometry_ = bare(odometry->child_frame_id);
      addOdometry(odometry->header.stamp.toSec(), planar(odometry->pose.pose));
    }
  }

  void addOdometry(double stamp, const Pose2& pose) {
    if (!pose.finite()) return;
    ++odometries_;
    recording_.events.push_back(OdometryEvent{stamp, pose});
  }

  void addReference(const rosbag::MessageInstance& entry) {
    recording_.reference_name = entry.getTopic();
    if (const auto pose = entry.instantiate<geometry_msgs::PoseStamped>()) {
      recording_.reference.emplace_back(pose->header.stamp.toSec(), planar(pose->pose));
    } else if (const auto spread = entry.instantiate<geometry_msgs::PoseWithCovarianceStamped>()) {
      recording_.reference.emplace_back(spread->header.stamp.toSec(), planar(spread->pose.pose));
    } else if (const auto odometry = entry.instantiate<nav_msgs::Odometry>()) {
      recording_.reference.emplace_back(odometry->header.stamp.toSec(),
                                        planar(odometry->pose.pose));
    }
  }

  void addScan(Scanner& scanner, const sensor_msgs::LaserScan& message) {
    ++scanner.scans;
    auto beams = openScan(message);
    if (!beams) {
      ++scanner.refused;
      scanner.reason = beams.reason();
      return;
    }
    const std::string base = base_.empty() ? base_in_odometry_ : base_;
    ScanEvent event{scanner.index, *beams, {}};
    if (scanner.stamped_at_end) event.beams.stamp -= beams->end() - beams->stamp;
    try {
      const auto transform =
          frames_.lookupTransform(base, scanner.frame, ros::Time(message.header.stamp));
      const auto mounting = levelMounting(tf2::transformToEigen(transform));
      if (!mounting) return static_cast<void>(++scanner.tilted);
      event.mounting = *mounting;
    } catch (const tf2::TransformException& unknown) {
      scanner.reason = unknown.what();
      return static_cast<void>(++scanner.lost);
    }
    recording_.events.push_back(std::move(event));
  }

  void closeNotes() {
    for (const auto& [topic, scanner] : scanners_) {
      const auto note = [&, name = topic](const std::string& text) {
        recording_.notes.push_back(name + ": " + text);
      };
      const std::string of = " of " + std::to_string(scanner.scans) + " scans ";
      if (scanner.stamped_at_end) {
        note(
            "arrives before its last beam can have been measured if stamped at the first: taken as "
            "stamped at the last");
      }
      if (scanner.refused)
        note(std::to_string(scanner.refused) + of + "refused: " + scanner.reason);
      if (scanner.tilted)
        note(std::to_string(scanner.tilted) + of + "left out: the scanner was not level");
      if (scanner.lost) note(std::to_string(scanner.lost) + of + "left out: " + scanner.reason);
    }
    if (recording_.reference.empty()) {
      recording_.notes.push_back("no topic with ground_truth in its name: nothing to judge by");
    }
  }

  rosbag::Bag bag_;
  PoseRecording recording_;
  std::map<std::string, std::string> parents_;  ///< of each frame
  tf2::BufferCore frames_{ros::Duration(1e7)};
  std::map<std::string, Scanner> scanners_;
  std::map<std::string, std::size_t> odometry_topics_;
  std::string base_, odom_, odometry_topic_, base_in_odometry_;
  std::size_t odometries_ = 0;
};

}  // namespace

Checked<PoseRecording> readPoseBag(const std::string& path) {
  try {
    auto recording = Reader(path).read();
    return recording ? std::move(recording)
                     : Checked<PoseRecording>::refused("'" + path + "': " + recording.reason());
  } catch (const rosbag::BagException& fault) {
    return Checked<PoseRecording>::refused("'" + path +
                                           "' cannot be read as a bag: " + fault.what());
  }
}

}  // namespace pilothouse::bench
