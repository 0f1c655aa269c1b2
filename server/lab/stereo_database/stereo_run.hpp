/// \file
/// One seed of the stereo experiment (spec S2.11): survey, drive with three databases, furniture that moves, update,
/// drive again, relocalisation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/lab/stereo_database/stereo_result.hpp"

namespace seeker::lab {

struct StereoSpec {
  std::filesystem::path config;  ///< folder
  std::uint64_t seed = 1;        ///< textures of the room, noise, which furniture moves
  bool paper = false;            ///< gates, descriptors and filter of the paper; else ours
  std::vector<std::string> overrides;
  bool smallest = false;  ///< fewer places to wake up at and fewer foreign views, to see that all of it runs
};

[[nodiscard]] Result<std::string> settings_of(const StereoSpec& spec);
[[nodiscard]] Result<StereoRecord> run_stereo(const StereoSpec& spec);

}  // namespace seeker::lab
