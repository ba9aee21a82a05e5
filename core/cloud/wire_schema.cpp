#include "core/cloud/wire_schema.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "core/cloud/message_definition.hpp"
#include "core/cloud/wire_walk.hpp"

namespace pilothouse {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;  // of what has a fixed length
constexpr int kDeepest = 32;

using Field = WireSchema::Field;
using Type = WireSchema::Type;

std::uint64_t checkedSize(std::uint64_t size, const std::string& name) {
  if (size > kMostBytes) throw std::runtime_error(name + " is too long");
  return size;
}

/// Orders the messages of a definition and adds up what is fixed.
class Assembly {
 public:
  Assembly(const std::vector<DefinedMessage>& messages, std::vector<Type>& types)
      : messages_(messages), types_(types) {}

  int add(const std::string& name, int depth) {
    const auto known = done_.find(name);
    if (known != done_.end()) return known->second;
    if (depth > kDeepest) throw std::runtime_error(name + " is made of itself, or too deep");
    const auto found = std::find_if(messages_.begin(), messages_.end(),
                                    [&name](const auto& m) { return means(name, m.name); });
    if (found == messages_.end()) throw std::runtime_error(name + " is not defined");
    Type type;
    type.name = name;
    for (const DefinedField& field : found->fields) append(type, fieldOf(field, depth));
    types_.push_back(std::move(type));
    return done_[name] = static_cast<int>(types_.size()) - 1;
  }

 private:
  /// A header is named without its package, whatever the package of who has it.
  static bool means(const std::string& name, const std::string& defined) {
    if (name != "Header") return name == defined;
    const std::size_t slash = defined.find('/');
    return slash != std::string::npos && defined.compare(slash + 1, std::string::npos, name) == 0;
  }

  Field fieldOf(const DefinedField& defined, int depth) {
    Field field;
    field.name = defined.name;
    field.count = !defined.array  ? Field::Count::kOne
                  : defined.times ? Field::Count::kFixed
                                  : Field::Count::kPrefixed;
    field.times = defined.times.value_or(1);
    field.size = builtInSize(defined.type);
    field.text = defined.type == "string";
    if (field.text) field.size = 4;
    if (field.size > 0) return field;
    const int type = add(defined.type, depth + 1);
    const Type& made_of = types_[static_cast<std::size_t>(type)];
    field.size = made_of.least;
    if (made_of.varies) field.type = type;
    return field;
  }

  static bool varies(const Field& field) {
    return field.text || field.type >= 0 || field.count == Field::Count::kPrefixed;
  }

  void append(Type& type, Field field) {
    if (field.count == Field::Count::kFixed && field.times == 0) return;
    const std::uint64_t least = field.count == Field::Count::kPrefixed
                                    ? 4
                                    : checkedSize(field.size * field.times, field.name);
    type.least = checkedSize(type.least + least, type.name);
    type.varies = type.varies || varies(field);
    if (!varies(field)) {
      field.size = least;  // one block, whatever it is made of
      field.count = Field::Count::kOne;
      field.times = 1;
      if (!type.fields.empty() && !varies(type.fields.back())) {
        type.fields.back().size += least;
        return;
      }
    }
    type.fields.push_back(std::move(field));
  }

  const std::vector<DefinedMessage>& messages_;
  std::vector<Type>& types_;
  std::map<std::string, int> done_;
};

/// One walk over the bytes.
struct Reading {
  const std::vector<Type>& types;
  const WireBounds& bounds;
  WireWalk walk;

  void message(const Type& type) {
    for (const Field& field : type.fields) {
      if (walk.stopped()) return;
      switch (field.count) {
        case Field::Count::kOne:
          elements(field, 1);
          break;
        case Field::Count::kFixed:
          elements(field, field.times);
          break;
        case Field::Count::kPrefixed: {
          const std::uint64_t most = field.size == 1 ? bounds.max_bytes : bounds.max_elements;
          const std::uint64_t element = std::max<std::uint64_t>(field.size, 1);
          // What takes no bytes cannot be bounded by them.
          elements(field, field.size > 0 ? walk.count(field.name.c_str(), most, element)
                                         : emptyOnes(field, most));
        }
      }
    }
  }

  std::uint64_t emptyOnes(const Field& field, std::uint64_t most) {
    const std::uint32_t claimed = walk.length(field.name.c_str());
    if (claimed > most) walk.refuse(LengthFault{field.name.c_str(), claimed, most});
    return claimed;
  }

  void elements(const Field& field, std::uint64_t times) {
    if (!field.text && field.type < 0) return walk.skip(times * field.size, field.name.c_str());
    for (std::uint64_t i = 0; i < times && !walk.stopped(); ++i) {
      if (field.text)
        walk.array(field.name.c_str(), bounds.max_text, 1);
      else
        message(types[static_cast<std::size_t>(field.type)]);
    }
  }
};

}  // namespace

Checked<WireSchema> WireSchema::parse(std::string_view type, std::string_view definition) {
  const std::string name(type);
  const auto messages = readDefinition(name, definition);
  if (!messages) return Checked<WireSchema>::refused(messages.reason());
  WireSchema schema;
  try {
    Assembly(*messages, schema.types_).add(name, 0);
  } catch (const std::runtime_error& fault) {
    return Checked<WireSchema>::refused(fault.what());
  }
  for (Type& made : schema.types_)
    for (Field& field : made.fields) field.name = made.name + " " + field.name;
  return Checked<WireSchema>::of(std::move(schema));
}

std::optional<LengthFault> WireSchema::fault(const std::uint8_t* bytes, std::size_t size,
                                             const WireBounds& bounds) const {
  Reading reading{types_, bounds, WireWalk(bytes, size)};
  reading.message(types_.back());
  return reading.walk.end();
}

}  // namespace pilothouse
