#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pilothouse {

/// Bytes of a regular file; no pipe or device, which might never end.
/// @throws std::runtime_error with the reason when there is none.
std::uint64_t fileSize(const std::string& path);

/// The first bytes of a file, `most` or all of it. @throws std::runtime_error
std::string readHead(const std::string& path, std::size_t most);

/// A whole file. @throws std::runtime_error also when it is larger than `most` bytes.
std::string readWhole(const std::string& path, std::size_t most);

/// Names (without the folder) of the entries of a folder, sorted. @throws std::runtime_error
std::vector<std::string> listFolder(const std::string& folder);

bool endsWith(const std::string& name, const std::string& ending);

}  // namespace pilothouse
