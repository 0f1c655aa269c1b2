/// \file
/// One seed of the stereo experiment (spec S2.11): survey, drive with three databases, furniture that moves, update,
/// drive again, relocalisation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/lab/s2_result.hpp"

namespace seeker::lab {

struct S2Spec {
  std::filesystem::path config;  ///< folder
  std::uint64_t seed = 1;        ///< textures of the room, noise, which furniture moves
  bool paper = false;            ///< gates, descriptors and filter of the paper; else ours
  std::vector<std::string> overrides;
};

[[nodiscard]] Result<std::string> settings_of(const S2Spec& spec);
[[nodiscard]] Result<S2Record> run_s2(const S2Spec& spec);

}  // namespace seeker::lab
