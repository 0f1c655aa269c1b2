#include "server/fleet/map_merger.hpp"

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"
#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

const std::vector<Point2> kWest{{1.0, 6.0}, {14.0, 6.0}, {2.0, 6.2}};
const std::vector<Point2> kEast{{23.0, 6.0}, {8.0, 5.9}, {20.0, 6.0}};

TEST(MapMerger, LaysTwoRobotsMapsUponEachOtherWithoutKnowingWhereTheyBegan) {
  const auto walls = office(1);
  const auto ways = std::pair(drive(kWest), drive(kEast));
  PreparedMap a = prepared(toy_map(walls, ways.first, 11));
  PreparedMap b = prepared(toy_map(walls, ways.second, 12));
  const MergeAnswer answer = MapMerger().merge(a, b);
  ASSERT_EQ(answer.verdict, MergeVerdict::kMerged) << answer.reason;
  const Pose2 truth = inverse(ways.first.front()) * ways.second.front();
  EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(truth, 0.15, 0.02));
}

TEST(MapMerger, DoesNotMergeTwoBuildings) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    PreparedMap a = prepared(toy_map(office(seed), drive(kWest), 11));
    PreparedMap b = prepared(toy_map(office(seed + 10), drive(kEast), 12));
    const MergeAnswer answer = MapMerger().merge(a, b);
    EXPECT_NE(answer.verdict, MergeVerdict::kMerged) << answer.reason;
  }
}

}  // namespace
}  // namespace seeker::fleet
