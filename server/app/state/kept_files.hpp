/// \file
/// Small files beside the map of a mission: where the robot was last, how far the mission had come, and what its
/// strategy remembers.
#pragma once

#include <filesystem>
#include <string>

#include "server/app/state/checkpoint.hpp"

namespace seeker::app {

/// Of one mission, in the folder of the checkpoints. The place outlives the program only, not a power cut. kIo.
[[nodiscard]] Status keep_place(const std::filesystem::path& folder, const api::MissionId& mission,
                                const MissionPlace& place);
[[nodiscard]] Status keep_memory(const std::filesystem::path& folder, const api::MissionId& mission,
                                 const MissionMemory& memory, std::uint32_t map_epoch);
/// What is there and whole; `trouble` says what was damaged, empty where nothing was. `map_epoch` is the map's.
[[nodiscard]] KeptState read_kept(const std::filesystem::path& folder, const api::MissionId& mission,
                                  std::uint32_t map_epoch, std::string& trouble);
/// Of all missions.
void drop_kept(const std::filesystem::path& folder);

}  // namespace seeker::app
