/// \file
/// Assignment of goals to robots by the path length and by the expected gain of information.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::fleet {

struct AuctionTask {
  Point2 p_map = Point2::Zero();
  double gain = 1.0;  ///< positive, in any unit, such as m2 of unknown floor
};

struct Bidder {
  std::string robot_id;            ///< unique identifier
  std::vector<double> distance_m;  ///< path length to every task; infinity where no path is known
};

struct AuctionParams {
  double lambda_1_m = 0.15;  ///< a metre of path multiplies the worth of a task by exp(-this)
  /// A task within this distance of an assigned one counts less, in proportion to the distance.
  double near_m = 5.0;
};

/// Assigns tasks in rounds: the best bid of all, gain * exp(-lambda * path length), gets its task; tasks near it lose
/// worth (Burgard et al. 2005). Each robot gets at most one task. The result does not depend on the order of robots and
/// tasks: of equal bids the one of the first robot by name wins, then the one for the task with the lowest x, then y.
/// Returns the index of the task of each bidder.
[[nodiscard]] std::vector<std::optional<std::size_t>> auction(const std::vector<Bidder>& bidders,
                                                              std::vector<AuctionTask> tasks,
                                                              const AuctionParams& params = {});

}  // namespace seeker::fleet
