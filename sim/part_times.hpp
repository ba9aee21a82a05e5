#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace pilothouse::sim {

/// Where the simulator's time goes.
class PartTimes {
 public:
  enum Part { kActors, kBase, kRangers, kRender, kDepthNoise, kColour, kParts };
  static constexpr std::array<const char*, kParts> kNames = {"actors", "base",        "rangers",
                                                             "render", "depth noise", "colour"};

  template <class Work>
  void measure(Part part, Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds_[part] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++times_[part];
  }
  double seconds(Part part) const { return seconds_[part]; }     ///< in all
  std::uint64_t times(Part part) const { return times_[part]; }  ///< how often it was done

 private:
  std::array<double, kParts> seconds_{};
  std::array<std::uint64_t, kParts> times_{};
};

}  // namespace pilothouse::sim
