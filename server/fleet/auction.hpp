/// \file
/// Who goes where: goals assigned to robots by the way there and by what they are expected to show.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::fleet {

struct AuctionTask {
  Point2 p_map = Point2::Zero();
  double gain = 1.0;  ///< > 0, any unit: m2 of unknown floor
};

struct Bidder {
  std::string robot_id;       ///< differs from those of all others
  std::vector<double> way_m;  ///< to every task; infinity where no way is known
};

struct AuctionParams {
  double lambda_1_m = 0.15;  ///< what is a metre farther counts exp(-this) as much
  double near_m = 5.0;       ///< a task so near to one that was given away counts less, in proportion to the distance
};

/// In rounds: the best bid of all, gain * exp(-lambda * way), gets its task; tasks near to it lose worth (Burgard et
/// al. 2005). Each robot gets one task at most. The outcome does not depend on the order of robots and tasks: of equal
/// bids the one of the first robot by name, then the one for the task with the lowest x, then y. By bidder: its task.
[[nodiscard]] std::vector<std::optional<std::size_t>> auction(const std::vector<Bidder>& bidders,
                                                              std::vector<AuctionTask> tasks,
                                                              const AuctionParams& params = {});

}  // namespace seeker::fleet
