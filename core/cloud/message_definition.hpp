#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// One line of a message's definition, constants and comments left out.
struct DefinedField {
  std::string type;  ///< built in, package/Name, or Header of whatever package
  std::string name;
  bool array = false;
  std::optional<std::uint64_t> times;  ///< of an array of fixed length
};

struct DefinedMessage {
  std::string name;  ///< package/Name
  std::vector<DefinedField> fields;
};

/// Reads the full text of a definition: the message `name`, then all others that it is made of,
/// each behind a line of = and "MSG: package/Name". The reason of a refusal names the line.
Checked<std::vector<DefinedMessage>> readDefinition(const std::string& name, std::string_view text);

/// Bytes of a built-in type; 0 for string and what is not built in.
std::uint64_t builtInSize(std::string_view type);

}  // namespace pilothouse
