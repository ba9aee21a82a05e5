#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>

#include <string>

#include "core/pose/pose_tracker.hpp"
#include "nodelets/scan_thread.hpp"

namespace pilothouse {

geometry_msgs::TransformStamped toTransform(const std_msgs::Header& header,
                                            const std::string& child, const Pose2& T_frame_child);
geometry_msgs::PoseWithCovarianceStamped::Ptr toPose(const std_msgs::Header& header,
                                                     const PoseEstimate& estimate);
/// Matches accepted, refused by reason, and how long ago one was accepted.
void report(diagnostic_updater::DiagnosticStatusWrapper& status, const ScanThread::Report& report);
/// Of a scanner that stamps its scans with the time of the last beam.
ScanBeams stampedAtBegin(ScanBeams beams);

}  // namespace pilothouse
