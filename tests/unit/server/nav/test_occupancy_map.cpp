#include "server/nav/occupancy_map.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "ascii_map.hpp"

namespace seeker::nav {
namespace {

LaserScan one_beam(float range_m) {
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 8.0;
  scan.ranges_m = {range_m};
  return scan;
}

const Pose2 kOrigin{0.025, 0.025, 0.0};

TEST(OccupancyMap, TwoSweepsMakeAWallAndTheWayThereIsFree) {
  OccupancyMap map;
  ASSERT_TRUE(map.integrate(one_beam(2.0F), kOrigin));
  ASSERT_TRUE(map.integrate(one_beam(2.0F), kOrigin));
  EXPECT_GT(map.probability_at({2.025, 0.025}).value(), 0.75);
  EXPECT_LT(map.probability_at({1.0, 0.025}).value(), 0.3);
  EXPECT_FALSE(map.probability_at({2.5, 0.025}));
  EXPECT_FALSE(map.probability_at({1.0, 0.2}));
}

TEST(OccupancyMap, APersonWhoLeavesIsForgottenWithinSevenSweeps) {
  OccupancyMap map;
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(map.integrate(one_beam(2.0F), kOrigin));
  }
  for (int k = 0; k < 7; ++k) {
    ASSERT_TRUE(map.integrate(one_beam(4.0F), kOrigin));
  }
  EXPECT_LT(map.probability_at({2.025, 0.025}).value(), 0.45);
}

TEST(OccupancyMap, GrazingBeamsDoNotEraseAWall) {
  std::vector<std::string> rows(6, std::string(60, '.'));
  rows.front() = std::string(60, '#');
  const Grid<std::uint8_t> world = ascii_map(rows, 0.1);
  OccupancyMap map;
  for (int k = 0; k < 50; ++k) {
    const Pose2 pose{0.5 + 0.05 * k, 0.3, 0.02};
    ASSERT_TRUE(map.integrate(scan_in(world, pose), pose));
  }
  for (double x = 1.0; x < 5.0; x += 0.05) {
    EXPECT_GT(map.probability_at({x + 0.01, 0.525}).value_or(0.0), 0.6) << "wall at x = " << x;
  }
}

TEST(OccupancyMap, ABeamWithoutReturnClearsOnlyUpToTheConfiguredRange) {
  OccupancyMap map;
  ASSERT_TRUE(map.integrate(one_beam(kNoReturn), kOrigin));
  EXPECT_LT(map.probability_at({3.9, 0.025}).value(), 0.5);
  EXPECT_FALSE(map.probability_at({4.3, 0.025}));
  OccupancyParams silent;
  silent.no_return_clear_m = 0.0;
  OccupancyMap untouched(silent);
  ASSERT_TRUE(untouched.integrate(one_beam(kNoReturn), kOrigin));
  EXPECT_EQ(untouched.tile_count(), 0U);
}

TEST(OccupancyMap, ALostBeamClearsNoFartherThanTheReturnsBesideIt) {
  LaserScan scan = one_beam(2.0F);
  scan.ranges_m = {2.0F, kNoReturn, kNoReturn, 1.5F};
  OccupancyMap map;
  ASSERT_TRUE(map.integrate(scan, kOrigin));
  EXPECT_LT(map.probability_at({1.3, 0.04}).value(), 0.5);
  for (double x = 1.7; x < 4.0; x += 0.05) {
    EXPECT_FALSE(map.probability_at({x, 0.025 + 0.015 * x})) << "behind the wall at x = " << x;
  }
}

TEST(OccupancyMap, TilesSinceARevisionAreOnlyTheChangedOnes) {
  OccupancyMap map;
  EXPECT_EQ(map.revision(), 0U);
  EXPECT_FALSE(map.snapshot());
  ASSERT_TRUE(map.integrate(one_beam(1.0F), kOrigin));
  const auto first = map.revision();
  EXPECT_EQ(map.tiles_since(0).size(), 1U);
  EXPECT_TRUE(map.tiles_since(first).empty());
  ASSERT_TRUE(map.integrate(one_beam(1.0F), Pose2{-11.0, 0.025, 0.0}));
  const auto later = map.tiles_since(first);
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later.front().index, (CellIndex{-4, 0}));
  EXPECT_GT(later.front().revision, first);
  const auto grid = map.snapshot();
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->width(), 5 * kTileSide_cells);
  EXPECT_EQ((*grid)[grid->frame().cell_of({1.025, 0.025})], map.tiles_since(0).back().cells[20]);
}

TEST(OccupancyMap, ASaturatedMapHasNothingNewToSend) {
  OccupancyMap map;
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(map.integrate(one_beam(2.0F), kOrigin));
  }
  const auto revision = map.revision();
  ASSERT_TRUE(map.integrate(one_beam(2.0F), kOrigin));
  EXPECT_EQ(map.revision(), revision);
}

TEST(OccupancyMap, RefusesWhatIsNotAScan) {
  OccupancyMap map;
  EXPECT_EQ(map.integrate(one_beam(std::numeric_limits<float>::quiet_NaN()), kOrigin).error().code,
            Errc::kInvalidArgument);
  EXPECT_EQ(map.integrate(one_beam(1.0F), Pose2{NAN, 0.0, 0.0}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(map.integrate(one_beam(1.0F), Pose2{1e9, 0.0, 0.0}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(map.revision(), 0U);
}

TEST(OccupancyMap, SaysWhenItIsFullAndKeepsWhatItHas) {
  OccupancyParams params;
  params.max_tiles = 1;
  OccupancyMap map(params);
  ASSERT_TRUE(map.integrate(one_beam(1.0F), kOrigin));
  EXPECT_EQ(map.integrate(one_beam(7.0F), kOrigin).error().code, Errc::kTooLarge);
  EXPECT_EQ(map.tile_count(), 1U);
  EXPECT_LT(map.probability_at({1.025, 0.025}).value(), 0.6);  // the part inside was written
}

TEST(OccupancyMap, SonarIsWeakAndNeverOverrulesTheLidar) {
  SonarScan sonar;
  sonar.range_max_m = 5.0;
  sonar.cone_half_angle_rad = 0.2;
  sonar.readings = {{Pose2{}, 1.0F}};
  OccupancyMap alone;
  ASSERT_TRUE(alone.integrate(sonar, kOrigin));
  EXPECT_LT(alone.probability_at({1.025, 0.025}).value(), 0.65);
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(alone.integrate(sonar, kOrigin));
  }
  EXPECT_GT(alone.probability_at({1.025, 0.025}).value(), 0.7);
  EXPECT_LT(alone.probability_at({0.5, 0.025}).value(), 0.3);

  OccupancyMap both;
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(both.integrate(one_beam(2.0F), kOrigin));
  }
  const double free_before = both.probability_at({1.025, 0.025}).value();
  sonar.readings = {{Pose2{}, 1.0F}};
  ASSERT_TRUE(both.integrate(sonar, kOrigin));
  EXPECT_EQ(both.probability_at({1.025, 0.025}).value(), free_before);
}

TEST(OccupancyMap, ClearForgetsEverythingAndTheRevisionStillRises) {
  OccupancyMap map;
  ASSERT_TRUE(map.integrate(one_beam(1.0F), kOrigin));
  const auto before = map.revision();
  map.clear();
  EXPECT_GT(map.revision(), before);
  EXPECT_FALSE(map.snapshot());
}

TEST(OccupancyMap, SurvivesTheWrapOfItsSweepCounter) {
  OccupancyMap map;
  for (int k = 0; k < 65534; ++k) {
    ASSERT_TRUE(map.integrate(one_beam(0.2F), kOrigin));
  }
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(map.integrate(one_beam(0.4F), kOrigin));
  }
  EXPECT_GT(map.probability_at({0.425, 0.025}).value(), 0.9);
}

}  // namespace
}  // namespace seeker::nav
