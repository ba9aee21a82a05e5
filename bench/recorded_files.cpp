#include "bench/recorded_files.hpp"

#include <algorithm>

namespace pilothouse::bench {

namespace fs = std::filesystem;

std::vector<fs::path> filesUnder(const std::string& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ends = name.size() >= ending.size() &&
                      name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
    if (ends && entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string nameUnder(const std::string& folder, const fs::path& file) {
  return file.lexically_relative(folder).generic_string();
}

std::string pictureName(const std::string& folder, const fs::path& file) {
  std::string name = file.lexically_relative(folder).replace_extension().generic_string();
  std::replace(name.begin(), name.end(), '/', '_');
  return name + ".png";
}

}  // namespace pilothouse::bench
