#include "server/app/fleet/known_others.hpp"

#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

/// What is known of others, and the robot that gets it.
struct KnownParts {
  ToyHost host{LineMap{}};
  app::KnownOthers others{"r1", host.host()};
};

TEST(KnownOthers, AreGivenToTheRobotWithTheFloorThatTheyHaveSeen) {
  KnownParts parts;
  api::FleetSightings sightings;
  sightings.floor = floor_with({1.0, 1.0});
  sightings.findings = {{"main", found_at(1, {1.0, 1.0})}};
  sightings.searched = {searched_at({}, 3, 200)};
  sightings.sides = {{{0.0, 2.0}, {3.0, 2.0}}};
  parts.others.receive(sightings);
  EXPECT_FALSE(parts.host.view()) << "it comes with the topologies";
  EXPECT_EQ(parts.host.events().size(), 1U);
  parts.others.receive(api::FleetShared{api::FleetState::kMerged, {at_place("main", {2.0, 1.0})}});
  ASSERT_TRUE(parts.host.view());
  EXPECT_EQ(parts.host.view()->robot_id, "r1");
  EXPECT_EQ(parts.host.view()->others.size(), 1U);
  EXPECT_TRUE(parts.host.view()->floor);
  EXPECT_TRUE(parts.host.view()->searched);
  ASSERT_TRUE(parts.host.view()->sides);
  EXPECT_EQ(*parts.host.view()->sides, sightings.sides);
}

TEST(KnownOthers, KeepTheirPlacesButNotTheirGoalsWithoutALink) {
  KnownParts parts;
  parts.others.receive(api::FleetShared{api::FleetState::kMerged, {at_place("main", {2.0, 1.0})}});
  parts.others.receive(Result<api::FleetShared>(fail(Errc::kLinkLost, "the link is cut")));
  ASSERT_TRUE(parts.host.view());
  EXPECT_FALSE(parts.host.view()->others.front().active);
  EXPECT_FALSE(parts.host.view()->others.front().velocity);
  EXPECT_EQ(parts.host.view()->others.front().topology.nodes.size(), 1U);
}

TEST(KnownOthers, AreForgottenWhereTheMapsAreDenied) {
  for (const api::FleetState state :
       {api::FleetState::kAmbiguous, api::FleetState::kContradicted, api::FleetState::kSplit}) {
    KnownParts parts;
    api::FleetSightings sightings;
    sightings.floor = floor_with({1.0, 1.0});
    sightings.sides = {{{0.0, 2.0}, {3.0, 2.0}}};
    parts.others.receive(sightings);
    parts.others.receive(api::FleetShared{api::FleetState::kMerged, {at_place("main", {2.0, 1.0})}});
    parts.others.receive(api::FleetShared{state, {}});
    EXPECT_FALSE(parts.host.view());
    parts.others.receive(api::FleetShared{api::FleetState::kMerged, {}});
    EXPECT_FALSE(parts.host.view()->floor);
    EXPECT_FALSE(parts.host.view()->sides);
  }
}

TEST(FleetNews, TellsOfATargetOnceAndAgainWhenItHasAPlace) {
  KnownParts parts;
  api::FleetSightings sightings;
  sightings.findings = {{"main", found_at(1, {1.0, 1.0})}};
  sightings.findings.front().detection.position.reset();
  parts.others.receive(sightings);
  parts.others.receive(sightings);
  EXPECT_EQ(parts.host.events().size(), 1U);
  sightings.findings.front().detection.position = Point2(1.0, 1.0);
  parts.others.receive(sightings);
  parts.others.receive(sightings);
  EXPECT_EQ(parts.host.events().size(), 2U);
}

}  // namespace
}  // namespace seeker::testing
