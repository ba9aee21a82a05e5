#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pilothouse::sim {

/// A whole word as a finite number; none where it is anything else (hexadecimal, nan, inf, 1e999).
inline std::optional<double> plainNumber(std::string_view word) {
  if (word.empty() || word.size() > 64) return std::nullopt;
  if (word.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return std::nullopt;
  const std::string text(word);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Words between blanks as finite numbers; none where one is not, or there are more than `most`.
inline std::optional<std::vector<double>> plainNumbers(std::string_view text, std::size_t most) {
  std::vector<double> values;
  constexpr const char* kBlank = " \t\r\n";
  for (auto begin = text.find_first_not_of(kBlank); begin != std::string_view::npos;
       begin = text.find_first_not_of(kBlank, begin)) {
    const auto end = std::min(text.find_first_of(kBlank, begin), text.size());
    const auto value = plainNumber(text.substr(begin, end - begin));
    if (!value || values.size() >= most) return std::nullopt;
    values.push_back(*value);
    begin = end;
  }
  return values;
}

}  // namespace pilothouse::sim
