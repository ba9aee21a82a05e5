// Whatever DepthView opens must be readable to the last pixel, and no pixel is a negative or
// non-finite depth; whatever it refuses has a reason.
#include <cmath>

#include "test/fuzz/depth_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  const DepthInput input(FuzzInput(data, size));
  const auto view = DepthView::open(input.bytes);
  if (!view) {
    require(!view.reason().empty());
    return 0;
  }
  require(view->intrinsics().fx >= 1.0 && view->intrinsics().fy >= 1.0);
  for (std::uint32_t row = 0; row < view->height(); ++row)
    for (std::uint32_t col = 0; col < view->width(); ++col) {
      const float metres = view->metres(row, col);
      require(std::isfinite(metres) && metres >= 0.0F);
    }
  return 0;
}
