#include "server/nav/surroundings.hpp"

#include <gtest/gtest.h>

#include "ascii_map.hpp"

namespace seeker::nav {
namespace {

TEST(Surroundings, AreHalfUnseenByALaserThatLooksAhead) {
  const Grid<std::uint8_t> room =
      ascii_map({"#########", "#.......#", "#.......#", "#.......#", "#.......#", "#########"}, 1.0);
  const Pose2 facing_the_wall{1.3, 3.0, kPi};
  OccupancyMap map;
  EXPECT_DOUBLE_EQ(unseen_share(map, facing_the_wall.translation(), 0.27, 1.0), 1.0);
  ASSERT_TRUE(map.integrate(scan_in(room, facing_the_wall), facing_the_wall));
  EXPECT_NEAR(unseen_share(map, facing_the_wall.translation(), 0.27, 1.0), 0.5, 0.1);
  const Pose2 turned{1.3, 3.0, 0.0};
  ASSERT_TRUE(map.integrate(scan_in(room, turned), turned));
  EXPECT_LT(unseen_share(map, facing_the_wall.translation(), 0.27, 1.0), 0.03) << "what the wall hides is not missing";
}

}  // namespace
}  // namespace seeker::nav
