#pragma once

#include <opencv2/core.hpp>

#include "bench/goal_trial.hpp"

namespace pilothouse::bench {

/// A run from above, and beside it what the navigator said when.
cv::Mat drawGoal(const GoalResult& result);

}  // namespace pilothouse::bench
