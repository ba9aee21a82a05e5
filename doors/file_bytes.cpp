#include "doors/file_bytes.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace pilothouse {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::uint64_t fileSize(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw std::runtime_error("no such file");
  if (!fs::is_regular_file(path, error)) throw std::runtime_error("not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw std::runtime_error("size cannot be read: " + error.message());
  return size;
}

std::string readHead(const std::string& path, std::size_t most) {
  const std::uint64_t size = fileSize(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot be opened for reading");
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(size, most)), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

std::string readWhole(const std::string& path, std::size_t most) {
  const std::uint64_t size = fileSize(path);
  if (size > most)
    throw std::runtime_error("file is " + std::to_string(size) + " bytes, expected at most " +
                             std::to_string(most));
  return readHead(path, most);
}

std::vector<std::string> listFolder(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    names.push_back(entry->path().filename().string());
  if (error) throw std::runtime_error("folder " + folder + " cannot be read: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

bool endsWith(const std::string& name, const std::string& ending) {
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace pilothouse
