// How long the floor takes, in one run with the streaming read of the same cloud and with what a
// user could choose instead. See --help.

#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <string>

#include "bench/bench_options.hpp"
#include "bench/interleaved_timing.hpp"
#include "bench/rivals.hpp"
#include "bench/standard_frame.hpp"
#include "bench/stream_read.hpp"
#include "core/floor/floor_segmenter.hpp"

namespace pilothouse::bench {
namespace {

// Greatest ratios of the improved method, binning and judging, to the warm streaming read.
constexpr double kCloudLimitAvx2 = 3.0;
constexpr double kCloudLimitSse4 = 4.5;
constexpr double kDepthLimit = 2.5;

const BenchCommand kCommand{
    "bench_perception",
    "usage: bench_perception [--rounds N] [--no-rivals] [--out FILE]\n"
    "Times the floor grid from clouds and depth, the streaming read of the same bytes, and PCL's\n"
    "and OctoMap's ways, on one processor and interleaved.\n"
    "  --rounds N    rounds of all fast cases, 5..100000 (default 300)\n"
    "  --no-rivals   leave PCL and OctoMap out\n"
    "  --out FILE    write a JSON object a line to FILE\n"
    "Limits, in warm streaming reads of the 16-byte cloud (medians): improved/cloud16 3 with "
    "AVX2,\n"
    "4.5 with SSE4; improved/depth 2.5. Ends with 1 where one is missed, 2 on a wrong call.\n",
    {"--no-rivals"}};

class Perception {
 public:
  explicit Perception(bool rivals) {
    addLimits("stream16", frame_.cloud16Words());
    addLimits("stream32", frame_.cloud32Words());
    addCopy();
    for (const BinningKernel kernel :
         {BinningKernel::kAvx2, BinningKernel::kSse4, BinningKernel::kReference}) {
      if (isSupported(kernel)) addGrids(kernel, kernel == fastestKernel() ? "" : suffix(kernel));
    }
    if (rivals) addRivals();
  }
  std::vector<TimedCase>& cases() { return cases_; }
  const StandardFrame& frame() const { return frame_; }

 private:
  static std::string suffix(BinningKernel kernel) {
    return kernel == BinningKernel::kSse4 ? "/sse4" : "/reference";
  }

  void add(const std::string& name, std::function<void()> work, std::function<void()> before = {}) {
    TimedCase c;
    c.name = name;
    c.work = std::move(work);
    c.before = std::move(before);
    cases_.push_back(std::move(c));
  }

  void addLimits(const std::string& name, const std::vector<float>& words) {
    const void* data = words.data();
    const std::size_t size = words.size() * sizeof(float);
    const auto read = [this, data, size] { sink_ = streamRead(data, size); };
    add(name + "/warm", read);
    if (evict(data, 0)) add(name + "/cold", read, [data, size] { evict(data, size); });
  }

  void addCopy() {
    const void* data = frame_.cloud16Words().data();
    copy_.resize(frame_.cloud16Words().size() * sizeof(float));
    const auto work = [this, data] { std::memcpy(copy_.data(), data, copy_.size()); };
    add("memcpy16/warm", work);
    if (!evict(data, 0)) return;
    add("memcpy16/cold", work, [this, data] {
      evict(data, copy_.size());
      evict(copy_.data(), copy_.size());
    });
  }

  void addGrids(BinningKernel kernel, const std::string& suffix) {
    for (const FloorMethod method : {FloorMethod::kOriginal, FloorMethod::kImproved}) {
      const bool improved = method == FloorMethod::kImproved;
      const std::string name = improved ? "improved/" : "original/";
      addGrid(name + "cloud16" + suffix, method, kernel, frame_.cloud16());
      if (improved && kernel != BinningKernel::kReference) {
        cases_.back().limit = kernel == BinningKernel::kAvx2 ? kCloudLimitAvx2 : kCloudLimitSse4;
      }
      addGrid(name + "cloud32" + suffix, method, kernel, frame_.cloud32());
      addGrid(name + "depth" + suffix, method, kernel, frame_.depth());
      if (improved && suffix.empty()) cases_.back().limit = kDepthLimit;
    }
  }

  template <class View>
  void addGrid(const std::string& name, FloorMethod method, BinningKernel kernel,
               const View& view) {
    FloorParameters parameters;
    parameters.method = method;
    const auto segmenter = std::make_shared<FloorSegmenter>(parameters);
    segmenter->useKernel(kernel);
    add(name, [this, segmenter, view] {
      sink_ = segmenter->segment(view, frame_.T_base_optical()).counts[0];
    });
  }

  void addRivals() {
    rivals_ = std::make_unique<Rivals>(frame_.validPoints(), Eigen::Vector3f::Zero());
    add("pcl/ransac_plane_2cm", [this] { sink_ = rivals_->ransacPlane(); });
    cases_.back().slow = true;
    add("pcl/region_growing_2cm", [this] { sink_ = rivals_->regionGrowing(); });
    cases_.back().slow = true;
    add("octomap/insert_5cm", [this] { sink_ = rivals_->insertOctomap(); });
    cases_.back().slow = true;
  }

  StandardFrame frame_;
  std::vector<unsigned char> copy_;
  std::unique_ptr<Rivals> rivals_;
  std::vector<TimedCase> cases_;
  volatile unsigned long long sink_ = 0;
};

int run(const BenchOptions& options) {
  const int processor = pinToOneProcessor();
  Perception perception(!options.has("--no-rivals"));
  std::printf(
      "640x480, %zu valid points, %s\n", perception.frame().validPoints().size(),
      processor < 0 ? "not pinned" : ("pinned to processor " + std::to_string(processor)).c_str());
  constexpr int kSlowRounds = 7;
  measure(perception.cases(), options.rounds, kSlowRounds);
  const auto missed = report("perception", perception.cases(), "stream16/warm", options.out);
  for (const std::string& text : missed) std::cerr << "bench_perception: " << text << "\n";
  return missed.empty() ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  const auto options = pilothouse::bench::readOptions(pilothouse::bench::kCommand, argc, argv);
  try {
    return pilothouse::bench::run(options);
  } catch (const std::exception& fault) {
    std::cerr << "bench_perception: " << fault.what() << "\n";
    return 2;
  }
}
