// Definitions from anywhere, and bytes read by them: what passes is read by a reader that trusts
// every length, as roscpp's does when it allocates. The first byte chooses a definition of those
// below, or the text that follows up to a zero.
#include "core/cloud/wire_schema.hpp"

#include "test/fuzz/input.hpp"

namespace pilothouse {
namespace {

const std::string kLine = "\n" + std::string(80, '=') + "\nMSG: ";
const std::string kHeader = "std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";
const std::string kDefinitions[] = {
    "Header header\nB[] b\nfloat64[9] k\nstring[2] s" + kLine + kHeader + kLine +
        "p/B\nstring name\nC[] c\nuint8[] data" + kLine + "p/C\nfloat32 x\nduration[] d\n",
    "string[] words\nE[] nothing\nint8 X=1" + kLine + "p/E\n",
};

/// Reads by the schema and trusts what it reads. ASan watches the bytes.
class Trusting {
 public:
  Trusting(const WireSchema& schema, const std::uint8_t* bytes, std::size_t size)
      : schema_(schema), bytes_(bytes), size_(size) {}

  void message(const WireSchema::Type& type) {
    for (const auto& field : type.fields) {
      std::uint64_t times = field.times;
      if (field.count == WireSchema::Field::Count::kPrefixed) times = u32();
      if (!field.text && field.type < 0) {
        copy(times * field.size);
        continue;
      }
      for (std::uint64_t i = 0; i < times; ++i) {
        if (field.text)
          copy(u32());
        else
          message(schema_.types()[static_cast<std::size_t>(field.type)]);
      }
    }
  }
  bool atEnd() const { return at_ == size_; }

 private:
  std::uint32_t u32() {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_ + at_, 4);
    at_ += 4;
    return value;
  }
  void copy(std::uint64_t count) {
    require(count <= size_);
    auto memory = std::make_unique<std::uint8_t[]>(count);
    if (count > 0) std::memcpy(memory.get(), bytes_ + at_, count);
    at_ += count;
  }

  const WireSchema& schema_;
  const std::uint8_t* bytes_;
  std::size_t size_, at_ = 0;
};

std::string definition(FuzzInput& input, std::uint8_t choice) {
  if (choice < std::size(kDefinitions)) return kDefinitions[choice];
  std::string text;
  while (input.left() > 0) {
    const char c = input.take<char>();
    if (c == '\0') break;
    text += c == '~' ? kLine : std::string(1, c);
  }
  return text;
}

}  // namespace
}  // namespace pilothouse

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const auto schema = WireSchema::parse("p/A", definition(input, input.take<std::uint8_t>()));
  if (!schema) {
    require(!schema.reason().empty());
    return 0;
  }
  const auto bytes = input.rest();
  const auto fault = schema->fault(bytes.data(), input.left());
  if (fault) {
    require(fault->value > fault->limit && !describe(*fault).empty());
    return 0;
  }
  Trusting in(*schema, bytes.data(), input.left());
  in.message(schema->types().back());
  require(in.atEnd());
  return 0;
}
