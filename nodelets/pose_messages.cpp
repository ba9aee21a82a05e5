#include "nodelets/pose_messages.hpp"

#include <boost/make_shared.hpp>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kFresh = 10.0;        // a match so recent keeps the pose right [s]
constexpr int kPlanar[3] = {0, 1, 5};  // x, y and turn about z, of six

geometry_msgs::Quaternion turnOf(double heading) {
  geometry_msgs::Quaternion turn;
  turn.z = std::sin(0.5 * heading);
  turn.w = std::cos(0.5 * heading);
  return turn;
}

}  // namespace

geometry_msgs::TransformStamped toTransform(const std_msgs::Header& header,
                                            const std::string& child, const Pose2& T_frame_child) {
  geometry_msgs::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = child;
  transform.transform.translation.x = T_frame_child.x;
  transform.transform.translation.y = T_frame_child.y;
  transform.transform.rotation = turnOf(T_frame_child.heading);
  return transform;
}

geometry_msgs::PoseWithCovarianceStamped::Ptr toPose(const std_msgs::Header& header,
                                                     const PoseEstimate& estimate) {
  const auto message = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  message->header = header;
  message->pose.pose.position.x = estimate.pose.x;
  message->pose.pose.position.y = estimate.pose.y;
  message->pose.pose.orientation = turnOf(estimate.pose.heading);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message->pose.covariance[static_cast<std::size_t>(6 * kPlanar[row] + kPlanar[column])] =
          estimate.covariance(row, column);
    }
  }
  return message;
}

void report(diagnostic_updater::DiagnosticStatusWrapper& status, const ScanThread::Report& report) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!report.accepted_ago) {
    status.summary(DiagnosticStatus::OK, "odometry alone: no match yet");
  } else if (*report.accepted_ago > kFresh) {
    status.summaryf(DiagnosticStatus::WARN, "odometry alone for %.0f s", *report.accepted_ago);
  } else {
    status.summary(DiagnosticStatus::OK, "matching");
  }
  for (std::size_t i = 0; i < ScanThread::kVerdicts; ++i) {
    status.add(std::string("matches: ") + nameOf(static_cast<MatchVerdict>(i)), report.matches[i]);
  }
  status.add("overtaken", report.overtaken);
  if (report.accepted_ago) status.add("last accepted [s ago]", *report.accepted_ago);
  status.add("last match [ms]", report.last_ms);
  status.add("last rms [m]", report.rms);
  status.add("last overlap", report.overlap);
  status.add("last squared Mahalanobis distance", report.distance);
  status.add("points of the map", report.mapped);
  for (std::size_t i = 0; i < report.lags.size(); ++i) {
    status.addf("stamps late, scanner " + std::to_string(i) + " [s]", "%.3f", report.lags[i]);
  }
}

ScanBeams stampedAtBegin(ScanBeams beams) {
  beams.stamp -= beams.end() - beams.stamp;
  return beams;
}

}  // namespace pilothouse
