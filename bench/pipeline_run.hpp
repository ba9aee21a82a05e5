#pragma once

#include <string>
#include <vector>

namespace pilothouse::bench {

/// What one way from the camera's message to the published grid took.
struct PipelineRun {
  std::string name;                  ///< e.g. manager/depth
  std::vector<double> latencies_ms;  ///< camera stamp to grid received, for each grid
  int frames_sent = 0;
  double processor_share = 0.0;  ///< of one processor, this process
};

/// Times of the core alone on the same frames, each a new message as from the camera, at the same
/// rate [ms].
std::vector<double> measureCore(bool depth, double seconds);

/// The floor nodelet with the grid's listener in this process, and the camera either here too
/// (shared pointers) or in a process of its own (TCPROS).
/// @param program this program, started again as the camera.
/// @throws std::runtime_error when no grid comes.
PipelineRun measurePipeline(bool depth, bool same_process, double seconds,
                            const std::string& program);

/// The camera's process of measurePipeline: waits for a listener, then publishes.
int runCamera(const std::string& name_space, bool depth, double seconds);

}  // namespace pilothouse::bench
