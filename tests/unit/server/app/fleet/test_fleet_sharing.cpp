#include "server/app/fleet/fleet_sharing.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

/// A fleet of the main robot and r1, whose map is merged 10 m away.
struct SharingParts : BookParts {
  explicit SharingParts(const app::OwnSeen& own,
                        const app::FleetSharingParams& params = {Duration::zero(), std::chrono::hours(1)})
      : BookParts({std::chrono::hours(1), seconds(10)}),
        host(LineMap{}, at_place("main", {2.0, 1.0}), own),
        sharing(params, book, main, host.host()) {
    join(packed(small_map()));
    book.settle(merged_at({10.0, 0.0, 0.0}));
  }
  ToyHost host;
  app::FleetSharing sharing;
};

TEST(FleetSharing, GivesARobotTheTopologyOfTheMainOne) {
  SharingParts parts(app::OwnSeen{});
  static_cast<void>(parts.sharing.refresh());
  static_cast<void>(parts.sharing.refresh());
  const auto shared = parts.sharing.share({"r1", 1, at_place("r1", {1.0, 0.0})});
  ASSERT_TRUE(shared);
  EXPECT_EQ(shared->state, api::FleetState::kMerged);
  ASSERT_EQ(shared->others.size(), 1U);
  EXPECT_EQ(shared->others.front().robot_id, "main");
  EXPECT_THAT(shared->others.front().map_T_base.translation(), Point2Near(Point2(-8.0, 1.0), 1e-9));
  EXPECT_EQ(parts.sharing.share({"r2", 1, {}}).error().code, Errc::kNotFound);
}

TEST(FleetSharing, GivesARobotWhatTheMainOneHasSeen) {
  SharingParts parts(app::OwnSeen{
      true, floor_with({4.0, 0.5}), {found_at(7, {4.0, 0.5})}, searched_at({}, 3, 200), {{{0.0, 2.0}, {3.0, 2.0}}}});
  static_cast<void>(parts.sharing.refresh());
  EXPECT_TRUE(parts.sharing.refresh()) << "the main robot has found something";
  EXPECT_FALSE(parts.sharing.refresh()) << "it has found nothing else since";
  const auto others = parts.sharing.seen(seen_by("r1"));
  ASSERT_TRUE(others);
  EXPECT_FALSE(others->floor.empty());
  ASSERT_EQ(others->findings.size(), 1U);
  EXPECT_THAT(*others->findings.front().detection.position, Point2Near(Point2(-6.0, 0.5), 1e-9));
  EXPECT_EQ(others->searched.size(), 1U);
  ASSERT_EQ(others->sides.size(), 1U);
  EXPECT_THAT(others->sides.front().left_map, Point2Near(Point2(-10.0, 2.0), 1e-9));
  EXPECT_EQ(parts.sharing.seen(seen_by("r2")).error().code, Errc::kNotFound);
}

TEST(FleetSharing, GivesTheMainRobotItsViewOfTheOthers) {
  SharingParts parts(app::OwnSeen{});
  ASSERT_TRUE(parts.sharing.share({"r1", 1, at_place("r1", {1.0, 0.0})}));
  api::FleetSeen seen = seen_by("r1", {found_at(1, {2.0, 0.0})}, searched_at({}, 3, 200));
  seen.tiles = floor_with({2.0, 0.0});
  seen.sides = {{{0.0, 2.0}, {3.0, 2.0}}};
  ASSERT_TRUE(parts.sharing.seen(seen));
  static_cast<void>(parts.sharing.refresh());
  const auto view = parts.host.view();
  ASSERT_TRUE(view);
  EXPECT_EQ(view->robot_id, "main");
  ASSERT_EQ(view->others.size(), 1U);
  EXPECT_THAT(view->others.front().map_T_base.translation(), Point2Near(Point2(11.0, 0.0), 1e-9));
  EXPECT_TRUE(view->floor);
  EXPECT_TRUE(view->searched);
  ASSERT_TRUE(view->sides);
  EXPECT_THAT(view->sides->front().right_map, Point2Near(Point2(13.0, 2.0), 1e-9));
  ASSERT_EQ(parts.host.events().size(), 1U);
  EXPECT_EQ(parts.host.events().front().rfind("fleet-found", 0), 0U);
}

TEST(FleetSharing, GivesTheMainRobotNothingInTheFrameOfAMapThatItHasNotTakenUp) {
  SharingParts parts(app::OwnSeen{});
  ASSERT_TRUE(parts.sharing.share({"r1", 1, at_place("r1", {1.0, 0.0})}));
  parts.main.keep_remembered();
  static_cast<void>(parts.sharing.refresh());
  EXPECT_FALSE(parts.host.view());
}

TEST(FleetSharing, ExchangesWhatWasSeenLessOftenThanTopologies) {
  SharingParts parts(app::OwnSeen{}, {std::chrono::hours(1), std::chrono::hours(1)});
  static_cast<void>(parts.sharing.refresh());
  ASSERT_TRUE(parts.sharing.share({"r1", 1, at_place("r1", {1.0, 0.0})}));
  ASSERT_TRUE(parts.sharing.seen(seen_by("r1", {}, searched_at({}, 3, 200))));
  static_cast<void>(parts.sharing.refresh());
  ASSERT_TRUE(parts.host.view());
  EXPECT_FALSE(parts.host.view()->searched);
}

TEST(Inbox, KeepsTheNewestAnswerUntilItIsTaken) {
  api::Reply<int> late;
  {
    app::Inbox<int> inbox;
    EXPECT_FALSE(inbox.take());
    late = inbox.reply();
    late(1);
    late(2);
    late(fail(Errc::kNotReady, "nothing"));
    EXPECT_EQ(inbox.take(), 2);
    EXPECT_FALSE(inbox.take());
  }
  late(3);  // the inbox is gone
}

}  // namespace
}  // namespace seeker::testing
