#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "server/tour/shares.hpp"

namespace seeker::tour {
namespace {

ShareCosts straight_shares(const std::vector<Point2>& robots, const std::vector<Point2>& places) {
  ShareCosts costs;
  const auto count = static_cast<Eigen::Index>(places.size());
  costs.between = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b < count; ++b) {
      costs.between(a, b) = (places[static_cast<std::size_t>(b)] - places[static_cast<std::size_t>(a)]).norm();
    }
  }
  for (const Point2& robot : robots) {
    std::vector<double>& legs_m = costs.from_robot.emplace_back();
    std::transform(places.begin(), places.end(), std::back_inserter(legs_m),
                   [&](const Point2& place) { return (place - robot).norm(); });
  }
  costs.bound_for.assign(robots.size(), ShareCosts::kNowhere);
  return costs;
}

TEST(Shares, OneRobotVisitsAllPlaces) {
  const std::vector<std::size_t> shares = shared_places(straight_shares({{0, 0}}, {{1, 0}, {5, 0}, {-3, 2}}));
  EXPECT_EQ(shares, (std::vector<std::size_t>{0, 0, 0}));
}

TEST(Shares, EachRobotTakesItsEndOfACorridor) {
  const std::vector<Point2> places{{1, 0}, {2, 0}, {3, 0}, {17, 0}, {18, 0}, {19, 0}};
  EXPECT_EQ(shared_places(straight_shares({{0, 0}, {20, 0}}, places)), (std::vector<std::size_t>{0, 0, 0, 1, 1, 1}));
}

TEST(Shares, WhereAllIsNearerToOneTheOtherHelps) {
  // Both stand at the same end; the places lie on both sides of it.
  const std::vector<Point2> places{{-4, 0}, {-6, 0}, {4, 0}, {6, 0}};
  const std::vector<std::size_t> shares = shared_places(straight_shares({{0, 0}, {0, 0.5}}, places));
  EXPECT_EQ(shares[0], shares[1]);
  EXPECT_EQ(shares[2], shares[3]);
  EXPECT_NE(shares[0], shares[2]);
}

TEST(Shares, APlaceStaysWithTheRobotOnItsWayThere) {
  ShareCosts costs = straight_shares({{0, 0}, {10, 0}}, {{1, 0}, {2, 0}});
  EXPECT_EQ(shared_places(costs)[0], 0U);
  costs.bound_for[1] = 0;
  EXPECT_EQ(shared_places(costs)[0], 1U);
}

TEST(Shares, NoRobotsTellsNoPlaces) { EXPECT_TRUE(shared_places(straight_shares({{0, 0}, {1, 1}}, {})).empty()); }

/// Length of a robot's share by visiting the nearest place next, which is no shorter than the best route.
double nearest_first_m(const ShareCosts& costs, const std::vector<std::size_t>& shares, std::size_t robot) {
  std::vector<bool> open(costs.places());
  std::transform(shares.begin(), shares.end(), open.begin(), [&](std::size_t k) { return k == robot; });
  double length_m = 0.0;
  std::optional<std::size_t> here;
  while (std::find(open.begin(), open.end(), true) != open.end()) {
    std::optional<std::size_t> next;
    const auto leg = [&](std::size_t to) {
      return here ? costs.between(static_cast<Eigen::Index>(*here), static_cast<Eigen::Index>(to))
                  : costs.from_robot[robot][to];
    };
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (open[k] && (!next || leg(k) < leg(*next))) {
        next = k;
      }
    }
    length_m += leg(*next);
    open[*next] = false;
    here = next;
  }
  return length_m;
}

TEST(Shares, TwoRobotsAreDoneMuchSoonerThanOne) {
  double alone_m = 0.0;
  double longer_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    std::vector<Point2> places;
    for (int k = 0; k < 24; ++k) {
      places.emplace_back(rng.uniform(0.0, 40.0), rng.uniform(0.0, 20.0));
    }
    const std::vector<Point2> robots{{0, 10}, {40, 10}};
    const ShareCosts two = straight_shares(robots, places);
    const std::vector<std::size_t> shares = shared_places(two);
    longer_m += std::max(nearest_first_m(two, shares, 0), nearest_first_m(two, shares, 1));
    const ShareCosts one = straight_shares({robots[0]}, places);
    alone_m += nearest_first_m(one, shared_places(one), 0);
  }
  EXPECT_LT(longer_m, 0.62 * alone_m) << "0.5 would be perfect";
}

TEST(Shares, NoneOfThreeRobotsStandsIdle) {
  Rng rng(7);
  std::vector<Point2> places;
  for (int k = 0; k < 12; ++k) {
    places.emplace_back(rng.uniform(0.0, 30.0), rng.uniform(0.0, 30.0));
  }
  const std::vector<std::size_t> once = shared_places(straight_shares({{3, 1}, {20, 9}, {8, 25}}, places));
  EXPECT_EQ(once, shared_places(straight_shares({{3, 1}, {20, 9}, {8, 25}}, places)));
  for (std::size_t robot = 0; robot < 3; ++robot) {
    EXPECT_GT(std::count(once.begin(), once.end(), robot), 0) << "robot " << robot << " has nothing to do";
  }
}

}  // namespace
}  // namespace seeker::tour
