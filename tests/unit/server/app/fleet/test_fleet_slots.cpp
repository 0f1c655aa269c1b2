#include "server/app/fleet/fleet_slots.hpp"

#include <gtest/gtest.h>

#include "common/api/fleet.hpp"

namespace seeker::app {
namespace {

TEST(FleetSlots, GiveARobotTheNumberThatItHad) {
  const FleetSlots slots(std::map<std::string, std::uint8_t>{{"r1", 4}});
  EXPECT_EQ(slots.number_for("r1", {}), 4);
}

TEST(FleetSlots, GiveANewRobotTheLowestNumberThatNoRobotHasHad) {
  const FleetSlots slots(std::map<std::string, std::uint8_t>{{"gone", 1}});
  EXPECT_EQ(slots.number_for("r2", {2}), 3);
  EXPECT_EQ(FleetSlots().number_for("r1", {}), kMainSlot + 1);
}

TEST(FleetSlots, GiveTheNumberOfARobotThatIsGoneWhereAllWereGivenOut) {
  FleetSlots slots;
  for (std::uint8_t slot = 1; slot < api::kMaxFleetRobots; ++slot) {
    slots.keep("r" + std::to_string(slot), slot);
  }
  EXPECT_EQ(slots.number_for("new", {1, 2}), 3);
}

}  // namespace
}  // namespace seeker::app
