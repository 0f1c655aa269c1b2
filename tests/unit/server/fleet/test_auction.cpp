#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/fleet/auction.hpp"

namespace seeker::fleet {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();

using Given = std::vector<std::optional<std::size_t>>;

TEST(Auction, SendsEachRobotToWhatIsNearIt) {
  const std::vector<AuctionTask> tasks{{{0.0, 0.0}, 1.0}, {{20.0, 0.0}, 1.0}};
  EXPECT_EQ(auction({{"a", {18.0, 2.0}}, {"b", {3.0, 17.0}}}, tasks), (Given{1, 0}));
}

TEST(Auction, SendsTheNearerOfTwoRobotsWhenBothWantTheSame) {
  const std::vector<AuctionTask> tasks{{{0.0, 0.0}, 1.0}, {{20.0, 0.0}, 1.0}};
  EXPECT_EQ(auction({{"a", {2.0, 18.0}}, {"b", {1.0, 19.0}}}, tasks), (Given{1, 0}));
}

TEST(Auction, PrefersWhatShowsMore) {
  EXPECT_EQ(auction({{"a", {5.0, 6.0}}}, {{{0.0, 0.0}, 1.0}, {{9.0, 0.0}, 9.0}}), (Given{1}));
  EXPECT_EQ(auction({{"a", {5.0, 60.0}}}, {{{0.0, 0.0}, 1.0}, {{9.0, 0.0}, 9.0}}), (Given{0}));
}

TEST(Auction, SendsTheSecondRobotElsewhereThanBesideTheFirst) {
  const std::vector<AuctionTask> tasks{{{0.0, 0.0}, 1.0}, {{0.5, 0.0}, 1.0}, {{9.0, 0.0}, 1.0}};
  const Given given = auction({{"a", {1.0, 1.5, 8.0}}, {"b", {1.2, 1.7, 8.2}}}, tasks);
  EXPECT_EQ(given, (Given{0, 2}));
}

TEST(Auction, LeavesARobotWithoutAPathAlone) {
  EXPECT_EQ(auction({{"a", {kNoWay}}, {"b", {50.0}}}, {{{0.0, 0.0}, 1.0}}), (Given{std::nullopt, 0}));
  EXPECT_EQ(auction({{"a", {}}}, {}), (Given{std::nullopt}));
  EXPECT_TRUE(auction({}, {{{0.0, 0.0}, 1.0}}).empty());
}

RC_GTEST_PROP(Auction, GivesTheSameWhateverTheOrder, ()) {
  const auto robots = *rc::gen::inRange<std::size_t>(1, 5);
  const auto places = *rc::gen::inRange<std::size_t>(1, 7);
  std::vector<AuctionTask> tasks;
  for (std::size_t k = 0; k < places; ++k) {
    // Whole numbers, so that equal bids are frequent; no two tasks at one place.
    tasks.push_back({{static_cast<double>(k), *rc::gen::inRange(0, 4) * 1.0}, *rc::gen::inRange(1, 3) * 1.0});
  }
  std::vector<Bidder> bidders;
  for (std::size_t r = 0; r < robots; ++r) {
    Bidder bidder{std::string(1, static_cast<char>('a' + r)), {}};
    for (std::size_t k = 0; k < places; ++k) {
      bidder.distance_m.push_back(*rc::gen::inRange(0, 5));
    }
    bidders.push_back(std::move(bidder));
  }
  const Given given = auction(bidders, tasks);
  std::set<std::size_t> taken;
  for (const auto& task : given) {
    if (task) {
      RC_ASSERT(taken.insert(*task).second);
    }
  }
  RC_ASSERT(taken.size() <= std::min(robots, places));

  std::vector<Bidder> turned(bidders.rbegin(), bidders.rend());
  for (Bidder& bidder : turned) {
    std::reverse(bidder.distance_m.begin(), bidder.distance_m.end());
  }
  const Given again = auction(turned, {tasks.rbegin(), tasks.rend()});
  for (std::size_t r = 0; r < robots; ++r) {
    const auto& other = again[robots - 1 - r];
    RC_ASSERT(given[r] == (other ? std::optional(places - 1 - *other) : std::nullopt));
  }
}

}  // namespace
}  // namespace seeker::fleet
