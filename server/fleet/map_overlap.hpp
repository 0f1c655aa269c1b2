/// \file
/// Two maps laid upon each other: how much wall both have seen, and how much of what both have looked at one denies.
#pragma once

#include <functional>

#include "server/fleet/prepared_map.hpp"
#include "server/slam/scan_matcher.hpp"

namespace seeker::fleet {

struct OverlapParams {
  double cell_m = 0.15;            ///< walls are counted by cells
  double partner_m = 0.15;         ///< a wall of one map has its partner in the other within this
  double min_normal_cosine = 0.7;  ///< and looks the same way
  double piece_gap_m = 0.3;        ///< cells of denied wall no farther apart are one piece
  double witness_wall_m = 6.0;     ///< shared by a local map alone: it speaks for itself then
  /// Maps bend: a node may settle by so much before it is counted.
  double settle_m = 0.3;
  double settle_rad = 0.05;
  slam::MatchParams match;
  slam::AgreementParams agreement;
  std::size_t match_points = 300;
};

struct MapOverlap {
  double shared_wall_m = 0.0;  ///< that both have seen
  double weak_wall_m = 0.0;    ///< of it, what tells the place along the direction told worst: little in a corridor
  /// 0 to 1: walls where the other looked through, and beams through its walls. What b itself has looked through is no
  /// wall of b: robots and people that stood there for a while.
  double contradiction = 0.0;
  /// The longest piece of wall of b that a has looked through, counted by cells of OverlapParams::cell_m.
  double denied_piece_m = 0.0;
  double residual_m = 0.0;    ///< root mean square distance of the shared walls
  std::size_t witnesses = 0;  ///< local maps of b that share OverlapParams::witness_wall_m with a, each fitted alone
};

/// What the nodes of b find in a. `map_a_T_node`: pose of a node of b, by index, in the frame `map` of a. The other
/// direction is another question: a may deny what b has seen and not the reverse.
[[nodiscard]] MapOverlap overlap_of(PreparedMap& a, PreparedMap& b,
                                    const std::function<Pose2(std::size_t)>& map_a_T_node,
                                    const OverlapParams& params = {});

}  // namespace seeker::fleet
