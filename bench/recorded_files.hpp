#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pilothouse::bench {

/// Every regular file under `folder`, with all its folders, whose name ends so; sorted.
std::vector<std::filesystem::path> filesUnder(const std::string& folder, const std::string& ending);

/// The path of `file` as seen from `folder`, for print.
std::string nameUnder(const std::string& folder, const std::filesystem::path& file);

/// A name for a picture of `file`: its path with what a file name cannot hold replaced.
std::string pictureName(const std::string& folder, const std::filesystem::path& file);

}  // namespace pilothouse::bench
