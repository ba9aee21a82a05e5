// Bytes that pass the bounds are read by a deserialiser that trusts every length, as roscpp's does
// when it allocates: it must never leave the bytes nor ask for more than they hold. The first byte
// of the input chooses the message.
#include "core/cloud/message_bounds.hpp"

#include <iterator>

#include "test/fuzz/input.hpp"

namespace pilothouse {
namespace {

/// Trusts what it reads. ASan watches the bytes.
class Trusting {
 public:
  Trusting(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), size_(size) {}
  std::uint32_t u32() {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_ + at_, 4);
    at_ += 4;
    return value;
  }
  void array(std::size_t element) {
    const std::size_t count = u32() * element;
    require(count <= size_);
    auto copy = std::make_unique<std::uint8_t[]>(count);
    if (count > 0) std::memcpy(copy.get(), bytes_ + at_, count);
    at_ += count;
  }
  void fixed(std::size_t count) {
    volatile std::uint8_t last = bytes_[at_ + count - 1];
    static_cast<void>(last);
    at_ += count;
  }
  bool atEnd() const { return at_ == size_; }

 private:
  const std::uint8_t* bytes_;
  std::size_t size_, at_ = 0;
};

void readCloud(Trusting& in) {
  in.fixed(12), in.array(1), in.fixed(8);
  for (std::uint32_t left = in.u32(); left > 0; --left) in.array(1), in.fixed(9);
  in.fixed(9), in.array(1), in.fixed(1);
}
void readImage(Trusting& in) {
  in.fixed(12), in.array(1), in.fixed(8), in.array(1), in.fixed(5), in.array(1);
}
void readCompressed(Trusting& in) {
  in.fixed(12), in.array(1), in.array(1), in.array(1);
}
void readInfo(Trusting& in) {
  in.fixed(12), in.array(1), in.fixed(8), in.array(1), in.array(8), in.fixed(240 + 25);
}
void readGrid(Trusting& in) {
  in.fixed(12), in.array(1), in.fixed(76), in.array(1), in.array(4), in.array(4), in.array(1);
}
void readObjects(Trusting& in) {
  in.fixed(12), in.array(1), in.array(1);
  for (std::uint32_t left = in.u32(); left > 0; --left) in.array(1), in.fixed(12);
  in.array(21);
}
void readPath(Trusting& in) {
  in.fixed(12), in.array(1);
  for (std::uint32_t left = in.u32(); left > 0; --left) in.fixed(12), in.array(1), in.fixed(56);
}

using Fault = std::optional<LengthFault> (*)(const std::uint8_t*, std::size_t,
                                             const MessageBounds&);
struct Message {
  Fault fault;
  void (*read)(Trusting&);
};
constexpr Message kMessages[] = {{pointCloud2Fault, readCloud},
                                 {imageFault, readImage},
                                 {compressedImageFault, readCompressed},
                                 {cameraInfoFault, readInfo},
                                 {floorGridFault, readGrid},
                                 {objectListFault, readObjects},
                                 {pathFault, readPath}};

}  // namespace
}  // namespace pilothouse

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const Message& message = kMessages[input.take<std::uint8_t>() % std::size(kMessages)];
  const auto bytes = input.rest();
  const auto fault = message.fault(bytes.data(), input.left(), {});
  if (fault) {
    require(fault->value > fault->limit && !describe(*fault).empty());
    return 0;
  }
  Trusting in(bytes.data(), input.left());
  message.read(in);
  require(in.atEnd());
  return 0;
}
