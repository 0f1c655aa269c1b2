#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/occupancy_tile.hpp"
#include "common/core/rng.hpp"
#include "server/search/evidence.hpp"

namespace seeker::search {
namespace {

/// 8 x 8 m about the origin, free, with a wall at x = 1 from y = -1 to 1.
Grid<std::uint8_t> room(bool wall = true) {
  Grid<std::uint8_t> grid({{-4.0, -4.0}, 0.05}, 160, 160, 0);
  for (int j = 60; wall && j < 100; ++j) {
    grid[{100, j}] = kOccupiedCell;
  }
  return grid;
}

/// What others tell of their looks for a box.
SearchedFloor told_by(const EvidenceGrid& other, const Pose2& map_T_grid = {}) {
  return {{"box"}, map_T_grid, std::make_shared<const Grid<std::uint8_t>>(other.own_looks({0.0, 0.0}, 60))};
}

Grid<std::uint8_t> floor_of(int side_cells) { return {{{-4.0, -4.0}, 0.2}, side_cells, side_cells, 1}; }

TEST(HitRate, FallsWithRangeRisesWithSize) {
  const HitRate rate;
  EXPECT_EQ(rate.probability(0.1, 0.4), 0.0);
  EXPECT_EQ(rate.probability(rate.max_range_m + 0.01, 0.4), 0.0);
  double last = 1.0;
  for (double r = rate.min_range_m; r < rate.max_range_m; r += 0.1) {
    EXPECT_LE(rate.probability(r, 0.4), last);
    EXPECT_LE(rate.probability(r, 0.2), rate.probability(r, 0.4));
    last = rate.probability(r, 0.4);
  }
}

TEST(Evidence, WallsAndRangeHide) {
  EvidenceGrid evidence;
  (void)evidence.add_look(room(), {0.0, 0.0}, 0.4);
  EXPECT_GT(evidence.probability_at({-1.1, 0.1}), 0.5);
  EXPECT_EQ(evidence.probability_at({1.9, 0.1}), 0.0);
  EXPECT_GT(evidence.probability_at({1.1, 2.5}), 0.1);  // past the wall's end
}

TEST(Evidence, UnknownHides) {
  Grid<std::uint8_t> grid = room(false);
  for (int j = 0; j < 160; ++j) {
    grid[{100, j}] = kUnknownCell;
  }
  EvidenceGrid evidence;
  (void)evidence.add_look(grid, {0.0, 0.0}, 0.4);
  EXPECT_EQ(evidence.probability_at({1.9, 0.1}), 0.0);
}

TEST(Evidence, LooksFromOnePlaceCountOnce) {
  EvidenceGrid evidence;
  (void)evidence.add_look(room(), {0.0, 0.0}, 0.4);
  const double once = evidence.probability_at({-2.1, 0.1});
  EXPECT_NEAR(evidence.add_look(room(), {0.0, 0.0}, 0.4), 0.0, 1e-6);
  EXPECT_NEAR(evidence.probability_at({-2.1, 0.1}), once, 1e-9);
  (void)evidence.add_look(room(), {0.0, 1.0}, 0.4);
  EXPECT_GT(evidence.probability_at({-2.1, 0.1}), once + 0.05);
}

TEST(Evidence, OthersCountLikeLooksFromPlacesOfTheirOwn) {
  EvidenceGrid other;
  (void)other.add_look(room(), {0.0, 1.0}, 0.4);
  EvidenceGrid own;
  (void)own.add_look(room(), {0.0, 0.0}, 0.4);
  const Point2 p(-2.1, 0.1);
  const double alone = own.probability_at(p);
  EvidenceGrid lone = own;
  own.set_others({told_by(other)});
  EXPECT_NEAR(own.probability_at(p), 1.0 - (1.0 - alone) * (1.0 - other.probability_at(p)), 0.01);
  EXPECT_GT(own.probability_at({0.1, 3.9}), 0.1) << "where only the other one has looked";
  // What another one has proved is left to gain no more.
  EXPECT_LT(own.add_look(room(), {0.0, 1.5}, 0.4), 0.9 * lone.add_look(room(), {0.0, 1.5}, 0.4));
}

TEST(Evidence, OthersMoveWithTheMapAndAreNeverTakenForOwnLooks) {
  EvidenceGrid other;
  (void)other.add_look(room(), {0.0, 1.0}, 0.4);
  EvidenceGrid lone;
  (void)lone.add_look(room(), {0.0, 0.0}, 0.4);
  EvidenceGrid both = lone;
  both.set_others({told_by(other)});
  EXPECT_EQ(both.own_looks({0.0, 0.0}, 60), lone.own_looks({0.0, 0.0}, 60));
  const Point2 p(-2.1, 0.1);
  const double before = both.probability_at(p);
  ASSERT_GT(before, lone.probability_at(p) + 0.05);
  const Pose2 new_T_old{2.0, 0.0, 0.0};
  both.transform(new_T_old);
  EXPECT_NEAR(both.probability_at(new_T_old * p), before, 1e-9);
  both.clear();
  EXPECT_EQ(both.probability_at(new_T_old * p), 0.0);
}

TEST(Evidence, OthersWithCellsOfAnotherSizeOrNoneSayNothing) {
  EvidenceGrid own;
  const auto coarse =
      std::make_shared<const Grid<std::uint8_t>>(GridFrame{{-4.0, -4.0}, 0.4}, 20, 20, std::uint8_t{200});
  own.set_others({{{"box"}, Pose2{}, coarse}, {{"box"}, Pose2{}, nullptr}});
  EXPECT_EQ(own.probability_at({0.1, 0.1}), 0.0);
}

TEST(Evidence, OthersMayLieInFramesOfTheirOwn) {
  EvidenceGrid other;
  (void)other.add_look(room(), {0.0, 0.0}, 0.4);
  const Pose2 map_T_grid{5.0, 2.0, 0.6};
  EvidenceGrid own;
  own.set_others({told_by(other, map_T_grid)});
  // Half a cell beside it the probability is hardly another; walls and ends of the range apart.
  for (const Point2& p : {Point2(-1.1, 0.1), Point2(-0.5, 1.3), Point2(-0.7, -1.1)}) {
    EXPECT_NEAR(own.probability_at(map_T_grid * p), other.probability_at(p), 0.1);
  }
  EXPECT_EQ(own.probability_at(map_T_grid * Point2(1.9, 0.1)), 0.0) << "behind the wall";
}

TEST(Evidence, OwnLooksAreToldWhereverTheSquareLiesAsLongAsTheyFitIntoIt) {
  EvidenceGrid evidence;
  (void)evidence.add_look(room(), {0.0, 0.0}, 0.4);
  const Grid<std::uint8_t> all = evidence.own_looks({0.0, 0.0}, 100);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(evidence.own_looks({500.0, 0.0}, std::max(all.width(), all.height())), all);
  EXPECT_TRUE(evidence.own_looks({500.0, 0.0}, std::max(all.width(), all.height()) - 1).empty());
}

TEST(Evidence, OfMoreOwnLooksThoseWithinTheSquareAreTold) {
  EvidenceGrid evidence;
  EXPECT_TRUE(evidence.own_looks({0.0, 0.0}, 100).empty());
  (void)evidence.add_look(room(), {0.0, 0.0}, 0.4);
  const Grid<std::uint8_t> near = evidence.own_looks({-1.0, 0.0}, 4);
  EXPECT_EQ(near.width(), 4);
  EXPECT_EQ(near.height(), 4);
  EXPECT_TRUE(evidence.own_looks({50.0, 0.0}, 10).empty());
}

RC_GTEST_PROP(Evidence, IsMonotoneAndBounded, (std::uint32_t seed)) {
  Rng rng(seed);
  const auto grid = room();
  EvidenceGrid evidence;
  std::vector<double> last(1600, 0.0);
  for (int look = 0; look < 4; ++look) {
    const Point2 camera(rng.uniform(-3.0, 0.9), rng.uniform(-3.0, 3.0));
    const double expected = evidence.expected_gain(grid, floor_of(40), camera, 0.4);
    const double gained = evidence.add_look(grid, camera, 0.4);
    RC_ASSERT(gained >= -1e-6);
    RC_ASSERT(std::abs(expected - gained) < 0.15 * gained + 1.0);
    for (int k = 0; k < 1600; ++k) {
      const double p = evidence.probability_at({-3.9 + 0.2 * (k % 40), -3.9 + 0.2 * (k / 40)});
      RC_ASSERT(p >= last[static_cast<std::size_t>(k)] - 1e-6);
      RC_ASSERT(p <= evidence.params().max_probability);
      last[static_cast<std::size_t>(k)] = p;
    }
  }
}

TEST(Evidence, ReportSumsUpAndListsGaps) {
  EvidenceGrid evidence;
  (void)evidence.add_look(room(), {-1.0, 0.0}, 0.4);
  const auto floor = floor_of(40);
  const auto report = evidence.report(floor, [](const Point2&) -> std::optional<std::string> { return std::nullopt; });
  EXPECT_NEAR(report.summary.reachable_area_m2, 64.0, 1e-9);
  double gap_area = 0.0;
  for (const Gap& gap : report.gaps) {
    EXPECT_EQ(gap.reason, "not seen");
    gap_area += gap.area_m2;
  }
  EXPECT_NEAR(gap_area + report.summary.covered_area_m2, 64.0, 1e-6);
  EXPECT_EQ(report.summary.gaps, static_cast<int>(report.gaps.size()));
  EXPECT_GT(report.summary.covered_area_m2, 10.0);
}

TEST(Evidence, ReportNamesForbiddenFloor) {
  const EvidenceGrid evidence;
  Grid<std::uint8_t> floor = floor_of(40);
  floor[{0, 0}] = 0;
  floor[{1, 0}] = 0;
  const auto report = evidence.report(floor, [](const Point2& p) -> std::optional<std::string> {
    return p.x() < -3.6 && p.y() < -3.8 ? std::optional<std::string>("keep-out") : std::nullopt;
  });
  ASSERT_EQ(report.gaps.size(), 2U);
  EXPECT_EQ(report.gaps[1].reason, "keep-out");
  EXPECT_NEAR(report.gaps[1].area_m2, 0.08, 1e-9);
  EXPECT_EQ((report.probability[{0, 0}]), kNotReachableFloor);
  EXPECT_EQ((report.probability[{5, 5}]), 0);
}

TEST(Evidence, MovesWithTheMap) {
  EvidenceGrid evidence;
  (void)evidence.add_look(room(), {0.0, 0.0}, 0.4);
  const double before = evidence.probability_at({-1.1, 0.1});
  evidence.transform(Pose2{2.0, 0.0, 0.0});
  EXPECT_NEAR(evidence.probability_at({0.9, 0.1}), before, 1e-9);
  // A turn leaves no holes.
  evidence.transform(Pose2{0.0, 0.0, 0.3});
  EXPECT_GT(evidence.probability_at(Pose2{0, 0, 0.3} * Point2(0.9, 0.1)), before - 0.1);
}

}  // namespace
}  // namespace seeker::search
