#include "core/replay/frame_pairs.hpp"

#include <set>
#include <string_view>

namespace pilothouse {

Checked<std::vector<FramePair>> pairFrames(const std::vector<std::string>& names) {
  using Result = Checked<std::vector<FramePair>>;
  constexpr std::string_view kDepth = "_depth.png", kColour = "_color.png";
  const std::set<std::string> sorted(names.begin(), names.end());
  std::vector<FramePair> pairs;
  for (const std::string& name : sorted) {
    if (name.size() < kDepth.size()) continue;
    const std::size_t stem = name.size() - kDepth.size();
    if (std::string_view(name).substr(stem) != kDepth) continue;
    const std::string colour = name.substr(0, stem) + std::string(kColour);
    pairs.push_back({name, sorted.count(colour) > 0 ? colour : std::string()});
  }
  if (pairs.empty())
    return Result::refused("folder has " + std::to_string(names.size()) +
                           " files but none named *_depth.png, expected one a picture");
  return Result::of(std::move(pairs));
}

}  // namespace pilothouse
