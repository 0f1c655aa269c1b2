/// \file
/// Furniture made of several boxes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/sim/world.hpp"

namespace seeker::sim {

/// A table: a top of `thickness_m` under `height_m` and four square legs.
struct TableShape {
  double length_m = 1.4;
  double width_m = 0.7;
  double height_m = 0.76;
  double thickness_m = 0.04;
  double leg_m = 0.06;
};
/// Pose: centre of the footprint, length along its x axis.
[[nodiscard]] std::vector<Box> make_table(const Pose2& world_T_table, const TableShape& shape, const Surface& surface,
                                          const std::string& object = {});

/// A bookcase: back, sides and boards, with books of all sizes and colours on them and gaps between.
struct BookcaseShape {
  double length_m = 1.6;
  double depth_m = 0.3;
  int shelves = 5;
  double shelf_m = 0.36;     ///< distance from board to board
  double empty_share = 0.2;  ///< share of the places for books that stay empty
};
/// Pose: centre of the footprint, length along its x axis; the books face along its y axis. The surface's pattern
/// number selects the books.
[[nodiscard]] std::vector<Box> make_bookcase(const Pose2& world_T_case, const BookcaseShape& shape,
                                             const Surface& surface, const std::string& object = {});

/// A chair with seat, back and legs; its seat faces along the x axis.
[[nodiscard]] std::vector<Box> make_chair(const Pose2& world_T_chair, const Surface& surface,
                                          const std::string& object = {});

}  // namespace seeker::sim
