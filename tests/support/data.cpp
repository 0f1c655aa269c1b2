#include "tests/support/data.hpp"

#include <cstdlib>

namespace seeker::testing {

std::filesystem::path source_file(const std::string& relative) {
  return std::filesystem::path(SEEKER_SOURCE_DIR) / relative;
}

std::optional<std::filesystem::path> recorded_data(const std::string& relative) {
  const char* folder = std::getenv("SEEKER_DATA");
  const std::filesystem::path root = folder != nullptr ? std::filesystem::path(folder) : source_file("../shared/data");
  std::filesystem::path path = root / relative;
  if (!std::filesystem::exists(path)) {
    return std::nullopt;
  }
  return path;
}

}  // namespace seeker::testing
