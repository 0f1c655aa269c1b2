#include "server/app/fleet/own_map.hpp"

#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

TEST(FloorOf, IsNullWhereNothingWasSeen) {
  EXPECT_FALSE(app::floor_of({}));
  EXPECT_TRUE(app::floor_of(floor_with({1.0, 1.0})));
}

TEST(SharedList, StaysTheSameObjectWhileItSaysTheSame) {
  EXPECT_FALSE(app::shared_list<SearchedFloor>({}, nullptr));
  const SharedSearch first = app::shared_list<SearchedFloor>({searched_at({}, 3, 200)}, nullptr);
  ASSERT_TRUE(first);
  EXPECT_EQ(app::shared_list<SearchedFloor>({searched_at({}, 3, 200)}, first), first);
  EXPECT_NE(app::shared_list<SearchedFloor>({searched_at({}, 4, 200)}, first), first);
  EXPECT_FALSE(app::shared_list<SearchedFloor>({}, first));
}

}  // namespace
}  // namespace seeker::testing
