// A .bt file is refused with a reason, or has as many nodes as its bytes can hold.
#include <string>

#include "core/mapping/octree_bytes.hpp"
#include "test/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const auto bytes = input.rest();
  const auto header = checkOctree({reinterpret_cast<const char*>(bytes.data()), size});
  if (!header) return require(!header.reason().empty()), 0;
  require(header->resolution >= 0.001 && header->resolution <= 10.0);
  require(header->data_offset <= size);
  require(header->nodes <= 1 + 4 * (size - header->data_offset));
  return 0;
}
