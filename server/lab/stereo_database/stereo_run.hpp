/// \file
/// One seed of the stereo experiment (spec S2.11): survey, drive with three databases, moved furniture, update, second
/// drive, relocalisation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/lab/stereo_database/stereo_result.hpp"

namespace seeker::lab {

struct StereoSpec {
  std::filesystem::path config;  ///< folder
  std::uint64_t seed = 1;        ///< selects the textures of the room, the noise, and which furniture is moved
  bool paper = false;            ///< true: robots/paper/stereo-2017.yaml; false: robots/stereo.yaml
  std::vector<std::string> overrides;
  bool smallest = false;  ///< fewer frames, places and foreign views, and no update of the paper's database: runs only
};

[[nodiscard]] Result<std::string> settings_of(const StereoSpec& spec);
[[nodiscard]] Result<StereoRecord> run_stereo(const StereoSpec& spec);

}  // namespace seeker::lab
