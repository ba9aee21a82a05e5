#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace pilothouse {

/// What is known of the file that a map is loaded from at the start and saved to by itself: whether
/// it is behind, and whether it may be written over. One thread at a time.
class KeptFile {
 public:
  /// @param name empty: there is none.
  explicit KeptFile(std::string name) : name_(std::move(name)), by_itself_(!name_.empty()) {}

  const std::string& name() const { return name_; }
  /// The name given, or the own. @throws std::runtime_error where there is neither.
  std::string chosen(const std::string& name) const;

  /// A version of the map is on the disk now under that name, by a person's hand or by itself.
  void saved(const std::string& name, std::uint64_t version);
  /// And the other way round: it came from there.
  void loaded(const std::string& name, std::uint64_t version);
  /// The file at the start is not one: it is not written over until one was saved or loaded by
  /// hand.
  void isBad(const std::string& fault);
  void failed(const std::string& fault) { fault_ = fault; }
  /// Whether the file is to be written. @param empty the map has nothing in it.
  bool isBehind(std::uint64_t version, bool empty) const {
    return by_itself_ && saved_ != version && (saved_ || !empty);
  }
  const std::string& fault() const { return fault_; }  ///< of files; empty: none

 private:
  std::string name_;
  bool by_itself_;
  std::optional<std::uint64_t> saved_;
  std::string fault_;
};

}  // namespace pilothouse
