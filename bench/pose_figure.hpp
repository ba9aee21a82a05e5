#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "bench/pose_recording.hpp"
#include "bench/pose_replay.hpp"

namespace pilothouse::bench {

/// The raw and the corrected track beside the reference (where there is one), over what the scans
/// met. Everything is laid upon the reference first, raw and corrected each by its own best fit.
cv::Mat drawTracks(const PoseRecording& recording, const PoseReplay& tracks,
                   const std::string& title);

}  // namespace pilothouse::bench
