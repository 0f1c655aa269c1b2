/// \file
/// Where recorded data lie that tests may use but the project does not contain.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace seeker::testing {

/// $SEEKER_DATA, or ../shared/data beside the repository; nothing where neither exists.
[[nodiscard]] std::optional<std::filesystem::path> recorded_data(const std::string& relative);
/// A file of the source tree, e.g. "config/robots/sim.yaml".
[[nodiscard]] std::filesystem::path source_file(const std::string& relative);

}  // namespace seeker::testing

/// Skips the running test, with its reason, where the recording is absent.
#define SEEKER_REQUIRE_DATA(variable, relative)                                                           \
  const auto variable##_found = ::seeker::testing::recorded_data(relative);                               \
  if (!variable##_found) {                                                                                \
    GTEST_SKIP() << "no recorded data: " << (relative) << " (set SEEKER_DATA to the folder that has it)"; \
  }                                                                                                       \
  const std::filesystem::path variable = *variable##_found
