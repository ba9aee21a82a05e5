#pragma once

#include <optional>
#include <string>
#include <utility>

namespace pilothouse {

/// A value that passed its checks, or the reason why it was refused.
template <class T>
class Checked {
 public:
  static Checked of(T value) {
    Checked result;
    result.value_.emplace(std::move(value));
    return result;
  }
  /// @param reason names the thing, its value and what was expected.
  static Checked refused(std::string reason) {
    Checked result;
    result.reason_ = std::move(reason);
    return result;
  }
  explicit operator bool() const { return value_.has_value(); }
  const T& operator*() const { return *value_; }
  const T* operator->() const { return &*value_; }
  const std::string& reason() const { return reason_; }

 private:
  std::optional<T> value_;
  std::string reason_;
};

}  // namespace pilothouse
