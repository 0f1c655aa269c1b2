#include "server/lab/experiments/seeds.hpp"
#include "server/lab/search/search_experiment.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/lab/search/cell_visits.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::lab {
namespace {

TEST(Seeds, RangesAndNumbersAreReadInOrderAndOnce) {
  const auto seeds = parse_seeds("7,1-3,2");
  ASSERT_TRUE(seeds);
  EXPECT_EQ(*seeds, (std::vector<std::uint64_t>{1, 2, 3, 7}));
}

TEST(Seeds, WhatIsNoListOfSeedsIsRefused) {
  for (const char* text : {"", "a", "3-1", "1-", "-3", "1,,2", "1-99999999", "1.5"}) {
    EXPECT_FALSE(parse_seeds(text)) << text;
  }
}

TEST(Seeds, EachMakesARunOfItsOwn) {
  RunSpec spec;
  spec.time_limit_s = 12.0;
  const std::vector<RunSpec> specs = with_seeds(spec, {7, 3});
  ASSERT_EQ(specs.size(), 2U);
  EXPECT_EQ(specs[0].seed, 7U);
  EXPECT_EQ(specs[1].seed, 3U);
  EXPECT_EQ(specs[1].time_limit_s, 12.0);
}

RC_GTEST_PROP(Seeds, PrintedSeedsReadBackAsTheSame, ()) {
  auto seeds = *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(0, 60));
  RC_PRE(!seeds.empty());
  const auto back = parse_seeds(print_seeds(seeds));
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  RC_ASSERT(back.has_value());
  RC_ASSERT(*back == seeds);
}

TEST(CellVisits, GoingBackToACellIsARepetition) {
  CellVisits visits(0.8, 0.1);
  for (const double x : {0.4, 0.5, 1.2, 2.0, 1.2, 0.4}) {
    visits.add({x, 0.4});
  }
  EXPECT_EQ(visits.visited(), 3);
  EXPECT_EQ(visits.repeated(), 2);
}

TEST(CellVisits, DrivingAlongABorderEntersNothing) {
  CellVisits visits(0.8, 0.1);
  visits.add({0.4, 0.4});
  for (int i = 0; i < 10; ++i) {
    visits.add({i % 2 == 0 ? 0.78 : 0.82, 0.4});
  }
  EXPECT_EQ(visits.visited(), 1);
  EXPECT_EQ(visits.repeated(), 0);
}

}  // namespace
}  // namespace seeker::lab
