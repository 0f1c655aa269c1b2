// A world behind a link: lost, awaited, back.

#include <gtest/gtest.h>

#include "server/app/loop/world_link.hpp"
#include "tests/unit/server/app/loop/fake_robot.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class WorldLinkTest : public ::testing::Test {
 protected:
  WorldLinkTest() {
    diagnostics.components().add("base", "driver", "fake", {});
    diagnostics.components().activate_all();
  }

  std::shared_ptr<testing::HandClock> clock = std::make_shared<testing::HandClock>();
  UpdateHub hub;
  LoopHooks hooks;
  Diagnostics diagnostics{clock, hub, hooks};
  WorldLink world{clock, "fake", milliseconds(100), seconds(10), diagnostics};
  WallTime wall;
};

TEST_F(WorldLinkTest, ALostWorldIsOneFaultAndItsDriversAreInError) {
  clock->link = fail(Errc::kNotReady, "the link is cut");
  EXPECT_FALSE(world.check());
  EXPECT_FALSE(world.check()) << "asked twice";
  ASSERT_EQ(diagnostics.faults().all().size(), 1U);
  EXPECT_EQ(diagnostics.faults().all()[0].id, "world-lost");
  EXPECT_FALSE(diagnostics.components().active("base"));
  EXPECT_TRUE(world.take_loss());
  EXPECT_FALSE(world.take_loss()) << "clients are told once";
  EXPECT_NE(world.within_reach().error().message.find("check that seeker-emulator runs"), std::string::npos);
}

TEST_F(WorldLinkTest, PatienceIsOfTheWallClockSinceRobotTimeStandsStill) {
  clock->link = fail(Errc::kNotReady, "the link is cut");
  EXPECT_TRUE(world.watch(wall));
  EXPECT_TRUE(world.lost());
  wall += seconds(9);
  EXPECT_TRUE(world.watch(wall));
  wall += seconds(2);
  EXPECT_EQ(world.watch(wall).error().message, "the link is cut");
  clock->link = {};
  EXPECT_TRUE(world.watch(wall));
  EXPECT_FALSE(world.lost());
}

TEST_F(WorldLinkTest, AWorldThatIsBackStartsItsDriversAndTheirPatienceAnew) {
  clock->link = fail(Errc::kNotReady, "the link is cut");
  EXPECT_FALSE(world.check());
  clock->link = {};
  clock->time += seconds(3);
  EXPECT_TRUE(world.check());
  EXPECT_EQ(world.back_at(), clock->time);
  EXPECT_TRUE(diagnostics.components().active("base"));
  EXPECT_TRUE(diagnostics.faults().all().empty());
}

TEST_F(WorldLinkTest, ASourceEndsOnceAndNothingIsWithinReachThen) {
  EXPECT_TRUE(world.within_reach());
  EXPECT_TRUE(world.end());
  EXPECT_FALSE(world.end());
  EXPECT_FALSE(world.within_reach());
}

}  // namespace
}  // namespace seeker::app
