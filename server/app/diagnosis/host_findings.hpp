/// \file
/// What to think of the machine that the robot's program runs on. Values in, values out.
#pragma once

#include <vector>

#include "common/api/diagnosis.hpp"
#include "server/app/diagnosis/host_facts.hpp"

namespace seeker::app {

// Below these amounts free there is a warning, or the check has failed.
inline constexpr std::uint64_t kFewDisk_bytes = 512ULL << 20U;
inline constexpr std::uint64_t kNoDisk_bytes = 64ULL << 20U;
inline constexpr std::uint64_t kFewMemory_bytes = 128ULL << 20U;
inline constexpr std::uint64_t kNoMemory_bytes = 32ULL << 20U;
/// A clock that shows an earlier year was never set: this program did not exist then.
inline constexpr int kFirstYear = 2025;

/// One finding for each check: robot-version, robot-disk, robot-folder, robot-memory, robot-clock, robot-journal,
/// robot-audit, robot-certificate.
[[nodiscard]] std::vector<api::Finding> judge(const HostFacts& facts);

}  // namespace seeker::app
