// Whatever CloudView opens must be readable to the last byte; whatever it refuses has a reason.
#include "test/fuzz/cloud_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  const CloudInput input(FuzzInput(data, size));
  const auto view = CloudView::open(input.bytes);
  if (!view) {
    require(!view.reason().empty());
    return 0;
  }
  volatile std::uint8_t seen = 0;
  volatile float sum = 0.0F;
  for (std::uint32_t row = 0; row < view->height(); ++row) {
    const std::size_t row_bytes = std::size_t{view->width()} * view->pointStep();
    for (std::size_t i = 0; i < row_bytes; ++i) seen = view->row(row)[i];
    for (std::uint32_t col = 0; col < view->width(); ++col) sum = view->point(row, col).sum();
  }
  static_cast<void>(seen);
  static_cast<void>(sum);
  return 0;
}
