#pragma once

#include <string>

namespace pilothouse {

/// Path of a file of this package, wherever it is built, linked or installed.
/// @param relative e.g. config/robots/platform.yaml
/// @throws std::runtime_error naming the file where there is none.
std::string packageFile(const std::string& relative);

}  // namespace pilothouse
