#include "common/core/mapped_side.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"

namespace seeker {
namespace {

using seeker::testing::Point2Near;

TEST(MappedSide, LeadsFromTheLeftToTheRightEndOfItsSegment) {
  MapSegment segment;
  segment.map_T_segment = {2.0, 1.0, kPi / 2};
  segment.length_m = 2.0;
  const std::vector<MappedSide> sides = sides_of({segment});
  ASSERT_EQ(sides.size(), 1U);
  EXPECT_THAT(sides.front().left_map, Point2Near(Point2(2.0, 0.0), 1e-12));
  EXPECT_THAT(sides.front().right_map, Point2Near(Point2(2.0, 2.0), 1e-12));
}

TEST(MappedSide, MovesWithTheFrame) {
  const std::vector<MappedSide> there = moved({{{1.0, 0.0}, {1.0, 2.0}}}, {5.0, 0.0, kPi / 2});
  EXPECT_THAT(there.front().left_map, Point2Near(Point2(5.0, 1.0), 1e-12));
  EXPECT_THAT(there.front().right_map, Point2Near(Point2(3.0, 1.0), 1e-12));
}

}  // namespace
}  // namespace seeker
