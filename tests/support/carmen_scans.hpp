/// \file
/// Whole recordings in memory.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "server/drivers/replay/carmen_reader.hpp"

namespace seeker::testing {

/// All laser scans of a CARMEN log; nothing where it cannot be opened.
[[nodiscard]] inline std::optional<std::vector<drivers::CarmenScan>> carmen_scans(const std::filesystem::path& path) {
  auto reader = drivers::CarmenReader::open(path);
  if (!reader) {
    return std::nullopt;
  }
  std::vector<drivers::CarmenScan> scans;
  while (auto record = reader->next()) {
    if (auto* scan = std::get_if<drivers::CarmenScan>(&*record)) {
      scans.push_back(std::move(*scan));
    }
  }
  return scans;
}

}  // namespace seeker::testing
