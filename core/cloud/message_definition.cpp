#include "core/cloud/message_definition.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "core/cloud/quoted.hpp"

namespace pilothouse {
namespace {

constexpr std::size_t kMostFields = 10000;  // in all; no message has nearly as many

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t from = text.find_first_not_of(kSpace);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kSpace) - from + 1);
}

std::string_view withoutComment(std::string_view text) {
  return trimmed(text.substr(0, text.find('#')));
}

bool isName(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '/';
  });
}

/// "float64[9]" taken apart. @throws std::runtime_error.
void readType(std::string_view text, const std::string& package, DefinedField& field) {
  const std::size_t bracket = text.find('[');
  const std::string_view base = text.substr(0, bracket);
  if (!isName(base)) throw std::runtime_error("type " + quoted(text) + ", expected a name");
  if (bracket != std::string_view::npos) {
    field.array = true;
    const std::string_view times = text.substr(bracket + 1, text.size() - bracket - 2);
    const bool digits =
        times.size() <= 9 && std::all_of(times.begin(), times.end(),
                                         [](unsigned char c) { return std::isdigit(c) != 0; });
    if (text.back() != ']' || !digits)
      throw std::runtime_error("type " + quoted(text) + ", expected a length between [ and ]");
    if (!times.empty()) field.times = std::stoull(std::string(times));
  }
  const bool own =
      builtInSize(base) == 0 && base != "string" && base.find('/') == std::string_view::npos;
  if (base == "Header")
    field.type = base;
  else
    field.type = own ? package + '/' + std::string(base) : std::string(base);
}

/// One line of a message; nothing for comments and constants. @throws std::runtime_error.
std::optional<DefinedField> readLine(std::string_view line, const std::string& package) {
  line = trimmed(line);
  if (line.empty() || line[0] == '#') return std::nullopt;
  const std::size_t space = line.find_first_of(" \t");
  if (space == std::string_view::npos)
    throw std::runtime_error("line " + quoted(line) + ", expected a type and a name");
  const std::string_view rest = trimmed(line.substr(space));
  // A constant's text may hold a #.
  const std::size_t equals = rest.find('=');
  if (equals != std::string_view::npos && equals < rest.find('#')) return std::nullopt;
  DefinedField field;
  readType(line.substr(0, space), package, field);
  field.name = withoutComment(rest);
  if (!isName(field.name)) throw std::runtime_error("name " + quoted(rest) + ", expected a name");
  return field;
}

bool isSeparator(std::string_view line) {
  return line.size() >= 20 && line.find_first_not_of('=') == std::string_view::npos;
}

std::string packageOf(const std::string& name) {
  return name.substr(0, name.find('/'));
}

}  // namespace

std::uint64_t builtInSize(std::string_view type) {
  for (const char* one : {"bool", "byte", "char", "int8", "uint8"})
    if (type == one) return 1;
  if (type == "int16" || type == "uint16") return 2;
  for (const char* four : {"int32", "uint32", "float32"})
    if (type == four) return 4;
  for (const char* eight : {"int64", "uint64", "float64", "time", "duration"})
    if (type == eight) return 8;
  return 0;
}

Checked<std::vector<DefinedMessage>> readDefinition(const std::string& name,
                                                    std::string_view text) {
  using Result = Checked<std::vector<DefinedMessage>>;
  std::vector<DefinedMessage> messages{{name, {}}};
  std::size_t number = 0, fields = 0;
  bool named = true;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    ++number;
    try {
      if (isSeparator(line)) {
        named = false;
      } else if (!named) {
        if (line.substr(0, 4) != "MSG:") throw std::runtime_error("expected MSG: package/Name");
        messages.push_back({std::string(trimmed(line.substr(4))), {}});
        named = true;
      } else if (auto field = readLine(line, packageOf(messages.back().name))) {
        if (++fields > kMostFields) throw std::runtime_error("more than 10000 fields");
        messages.back().fields.push_back(std::move(*field));
      }
    } catch (const std::runtime_error& fault) {
      return Result::refused("definition of " + quoted(name) + ", line " + std::to_string(number) +
                             ": " + fault.what());
    }
  }
  return Result::of(std::move(messages));
}

}  // namespace pilothouse
