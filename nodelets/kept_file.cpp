#include "nodelets/kept_file.hpp"

#include <stdexcept>

namespace pilothouse {

std::string KeptFile::chosen(const std::string& name) const {
  if (!name.empty()) return name;
  if (name_.empty()) throw std::runtime_error("name is empty, expected that of a map");
  return name_;
}

void KeptFile::saved(const std::string& name, std::uint64_t version) {
  if (name != name_) return;
  saved_ = version;
  by_itself_ = true;
  fault_.clear();
}

void KeptFile::loaded(const std::string& name, std::uint64_t version) {
  saved(name, version);
  fault_.clear();
}

void KeptFile::isBad(const std::string& fault) {
  fault_ = fault;
  by_itself_ = false;
}

}  // namespace pilothouse
