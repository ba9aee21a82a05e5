#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <Eigen/Geometry>

#include "core/floor/mounting_calibrator.hpp"

namespace pilothouse {

/// From here on a camera is not where its configuration says.
constexpr double kMountingAngleWarning = 1.5;    ///< [deg]
constexpr double kMountingHeightWarning = 0.03;  ///< [m]

/// What the floor says of the camera's mounting and how far that is from the configured one: a
/// warning beyond the limits above.
/// @param used whether the estimate replaces the configured mounting.
void reportEstimate(const MountingEstimate& estimate, bool used,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

/// The mounting that was found in the newest picture. @param T_base_optical identity: none yet.
void reportFound(const Eigen::Isometry3f& T_base_optical,
                 diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace pilothouse
