#include "nodelets/mounting_report.hpp"

#include <cmath>

#include "core/floor/plane_search.hpp"

namespace pilothouse {
namespace {

using diagnostic_msgs::DiagnosticStatus;

double degrees(double radians) {
  return radians * 180.0 / 3.14159265358979323846;
}

}  // namespace

void reportEstimate(const MountingEstimate& estimate, bool used,
                    diagnostic_updater::DiagnosticStatusWrapper& status) {
  const double pitch_error = degrees(estimate.pitch_error);
  const double roll_error = degrees(estimate.roll_error);
  status.add("estimate used", used);
  status.add("frames", estimate.frames);
  if (!estimate.valid) {
    status.summary(DiagnosticStatus::OK, "not estimated: too little floor seen so far");
    return;
  }
  status.add("height [m]", estimate.height);
  status.add("pitch [deg]", degrees(estimate.pitch));
  status.add("roll [deg]", degrees(estimate.roll));
  status.add("height error [m]", estimate.height_error);
  status.add("pitch error [deg]", pitch_error);
  status.add("roll error [deg]", roll_error);
  const bool off = !(std::abs(pitch_error) <= kMountingAngleWarning) ||
                   !(std::abs(roll_error) <= kMountingAngleWarning) ||
                   !(std::abs(estimate.height_error) <= kMountingHeightWarning);
  if (!off) {
    status.summary(DiagnosticStatus::OK, "as configured");
    return;
  }
  status.summaryf(DiagnosticStatus::WARN,
                  "the camera is not mounted as configured: %+.1f cm higher, pitch %+.1f deg, "
                  "roll %+.1f deg",
                  estimate.height_error * 100.0, pitch_error, roll_error);
}

void reportFound(const Eigen::Isometry3f& T_base_optical,
                 diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (T_base_optical.isApprox(Eigen::Isometry3f::Identity())) {
    status.summary(DiagnosticStatus::OK, "not found: no picture yet");
    return;
  }
  const Eigen::Vector3d up = T_base_optical.linear().row(2).transpose().cast<double>();
  status.summary(DiagnosticStatus::OK, "found in the picture itself");
  status.add("height [m]", T_base_optical.translation().z());
  status.add("pitch [deg]", degrees(pitchOf(up)));
  status.add("roll [deg]", degrees(rollOf(up)));
}

}  // namespace pilothouse
