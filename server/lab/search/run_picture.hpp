/// \file
/// Pictures of one run.
#pragma once

#include "server/lab/search/search_run.hpp"

namespace seeker::lab {

/// Picture of the robot's knowledge at the end: its map, lists, evidence, path and finds. Error: kNotReady when there
/// is no map.
[[nodiscard]] Result<Image> draw_run(const RunRecord& record);

/// Picture of the true run, as Fig 6 of the search paper: the world from above with the true path, the cells of both
/// lists, the ray of the first find and the target.
[[nodiscard]] Image draw_in_world(const RunRecord& record, const std::string& title);

}  // namespace seeker::lab
