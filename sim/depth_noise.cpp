#include "sim/depth_noise.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::sim {

double DepthNoise::sigma(double depth) const {
  const double beyond = std::max(0.0, depth - start);
  return floor + slope * beyond * beyond;
}

double DepthNoise::measure(double depth, Random& random) const {
  const double shift = random.normal();
  const bool lost = random.chance(drop_out);
  if (!(depth > 0.0) || lost) return 0.0;
  const double noisy = depth + sigma(depth) * shift;
  if (!(noisy >= nearest && noisy <= farthest)) return 0.0;
  const double disparity = std::floor(focal_baseline / noisy * disparity_steps + 0.5);
  return focal_baseline * disparity_steps / disparity;
}

void measure(const std::vector<float>& depths, const DepthNoise& noise, Random& random,
             std::vector<std::uint16_t>& image) {
  image.resize(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double z = noise.measure(static_cast<double>(depths[i]), random);
    image[i] = static_cast<std::uint16_t>(z * 1000.0 + 0.5);
  }
}

}  // namespace pilothouse::sim
