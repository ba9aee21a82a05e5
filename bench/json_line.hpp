#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace pilothouse::bench {

/// Builds one JSON object on one line. Keys and texts are our own or file names.
class JsonLine {
 public:
  JsonLine& text(const std::string& key, const std::string& value) {
    return raw(key, quoted(value));
  }
  template <class Integer>
  JsonLine& whole(const std::string& key, Integer value) {
    return raw(key, std::to_string(value));
  }
  JsonLine& truth(const std::string& key, bool value) { return raw(key, value ? "true" : "false"); }
  /// A number that is not finite, as null.
  JsonLine& number(const std::string& key, double value, int decimals = 3) {
    if (!std::isfinite(value)) return raw(key, "null");
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.*f", decimals, value);
    return raw(key, digits);
  }
  JsonLine& object(const std::string& key, const JsonLine& value) { return raw(key, value.str()); }
  std::string str() const { return '{' + body_ + '}'; }

 private:
  static std::string quoted(const std::string& value) {
    std::string out = "\"";
    for (const char c : value) {
      if (c == '"' || c == '\\') out += '\\';
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + '"';
  }
  JsonLine& raw(const std::string& key, const std::string& value) {
    if (!body_.empty()) body_ += ',';
    body_ += quoted(key) + ':' + value;
    return *this;
  }
  std::string body_;
};

}  // namespace pilothouse::bench
