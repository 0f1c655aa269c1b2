#include "server/fleet/auction.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

struct Bid {
  double value = 0.0;
  std::size_t bidder = 0;
  std::size_t task = 0;
};

bool better(const Bid& a, const Bid& b, const std::vector<Bidder>& bidders, const std::vector<AuctionTask>& tasks) {
  const auto key = [&](const Bid& bid) {
    const Point2& p = tasks[bid.task].p_map;
    return std::make_tuple(-bid.value, bidders[bid.bidder].robot_id, p.x(), p.y());
  };
  return key(a) < key(b);
}

std::optional<Bid> best_bid(const std::vector<Bidder>& bidders, const std::vector<AuctionTask>& tasks,
                            const std::vector<std::optional<std::size_t>>& given, const AuctionParams& params) {
  std::optional<Bid> best;
  for (std::size_t bidder = 0; bidder < bidders.size(); ++bidder) {
    if (given[bidder]) {
      continue;
    }
    SEEKER_ASSERT(bidders[bidder].distance_m.size() == tasks.size());
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      const Bid bid{tasks[task].gain * std::exp(-params.lambda_1_m * bidders[bidder].distance_m[task]), bidder, task};
      if (bid.value > 0.0 && (!best || better(bid, *best, bidders, tasks))) {
        best = bid;
      }
    }
  }
  return best;
}

}  // namespace

std::vector<std::optional<std::size_t>> auction(const std::vector<Bidder>& bidders, std::vector<AuctionTask> tasks,
                                                const AuctionParams& params) {
  std::vector<std::optional<std::size_t>> given(bidders.size());
  while (const std::optional<Bid> bid = best_bid(bidders, tasks, given, params)) {
    given[bid->bidder] = bid->task;
    const Point2 taken_map = tasks[bid->task].p_map;
    for (AuctionTask& task : tasks) {
      task.gain *= std::min(1.0, (task.p_map - taken_map).norm() / params.near_m);
    }
  }
  return given;
}

}  // namespace seeker::fleet
