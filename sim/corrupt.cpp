#include "sim/corrupt.hpp"

#include <array>
#include <limits>

namespace pilothouse::sim {
namespace {

double absurd(Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array<double, 5> values = {std::numeric_limits<double>::quiet_NaN(), kInfinity,
                                        -kInfinity, 1e30, -1e9};
  return values[static_cast<std::size_t>(random.integer(0, 4))];
}

template <class T>
void spoil(std::vector<T>& pixels, Random& random) {
  if (random.chance(0.5)) {
    pixels.resize(static_cast<std::size_t>(random.unit() * static_cast<double>(pixels.size())));
  }
  for (T& pixel : pixels) pixel = static_cast<T>(random.integer(0, std::numeric_limits<T>::max()));
}

}  // namespace

void corrupt(std::shared_ptr<const DepthImage>& image, Random& random) {
  auto copy = std::make_shared<DepthImage>(*image);
  spoil(copy->millimetres, random);
  image = std::move(copy);
}

void corrupt(std::shared_ptr<const ColourImage>& image, Random& random) {
  auto copy = std::make_shared<ColourImage>(*image);
  spoil(copy->rgb, random);
  image = std::move(copy);
}

void corrupt(OdometryReading& reading, Random& random) {
  double* const fields[] = {&reading.pose.x,   &reading.pose.y,   &reading.pose.heading,
                            &reading.twist.vx, &reading.twist.vy, &reading.twist.w};
  *fields[random.integer(0, 5)] = absurd(random);
}

void corrupt(ImuReading& reading, Random& random) {
  const int axis = random.integer(0, 2);
  (random.chance(0.5) ? reading.rate : reading.acceleration)[axis] = absurd(random);
}

void corrupt(double& range, Random& random) {
  range = absurd(random);
}

}  // namespace pilothouse::sim
