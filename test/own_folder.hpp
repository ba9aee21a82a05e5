#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace pilothouse {

/// A folder that nobody else uses, however many tests run side by side, and that goes with its
/// test.
struct OwnFolder {
  OwnFolder() {
    std::string pattern = testing::TempDir() + "/pilothouse_test_XXXXXX";
    EXPECT_NE(mkdtemp(pattern.data()), nullptr) << pattern;
    path = pattern;
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  std::string path;
};

/// The one of this process.
inline const std::string& ownFolder() {
  static const OwnFolder folder;
  return folder.path;
}

}  // namespace pilothouse
