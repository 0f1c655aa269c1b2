/// \file
/// Maps of different drawn buildings, which must never be merged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/lab/active_slam/explore_run.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/table.hpp"

namespace seeker::lab {

/// What one robot has mapped of one building.
struct BuildingMap {
  std::string world;
  std::uint64_t seed = 0;
  LineMap map;
};

/// Two maps of different buildings and what the merger says of them.
struct OtherBuildings {
  std::string a;
  std::string b;
  std::string verdict;
  double shared_wall_m = 0.0;  ///< these of the best hypothesis
  double contradiction = 0.0;
  double deformation_ratio = 0.0;
};

/// Explores each world for the time limit of its spec. Errors are those of run_explore().
[[nodiscard]] Result<std::vector<BuildingMap>> map_buildings(const std::vector<ExploreSpec>& specs);
/// Compares all pairs of maps of different worlds. Errors are those of fleet::PreparedMap::update().
[[nodiscard]] Result<std::vector<OtherBuildings>> compare_buildings(const std::vector<BuildingMap>& maps);
/// Checks that no two different buildings are merged.
[[nodiscard]] Check check_other_buildings(const std::vector<OtherBuildings>& pairs);
[[nodiscard]] Table other_buildings_table(const std::vector<OtherBuildings>& pairs);

}  // namespace seeker::lab
