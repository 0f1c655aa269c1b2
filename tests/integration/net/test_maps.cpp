#include "tests/integration/net/fixture.hpp"
#include "tests/support/maps/random_map.hpp"

namespace seeker::testing {
namespace {

class MapCallsTest : public NetTest {
 protected:
  MapCallsTest() {
    robot_.edit([](FakeRobotValues& v) {
      v.segments = api::SegmentUpdate{3, 1, true, room_map().segments, {}};
      v.map_files["office"] = std::vector<std::uint8_t>(100'000, 7);
    });
  }
  static api::SegmentUpdate change(std::uint64_t revision, std::uint64_t removed) {
    return {revision, 1, false, {}, {removed}};
  }
};

TEST_F(MapCallsTest, ValuesComeBackAsTheRobotHasThem) {
  start();
  const auto client = connect("tester");
  const auto saved = ask<api::MapSummary>([&](auto r) { client->save_map("office", false, r); });
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->segments, 4U);
  EXPECT_EQ(ask<api::MapSummary>([&](auto r) { client->load_map("office", api::MapUse::kLocalise, r); }), *saved);
  EXPECT_EQ(ask<api::MapSummary>([&](auto r) { client->inspect_map("office", true, r); }), *saved);
  EXPECT_EQ(ask<std::vector<api::MapSummary>>([&](auto r) { client->list_maps(r); })->size(), 1U);
  EXPECT_EQ(ask<std::vector<std::uint8_t>>([&](auto r) { client->download_map("office", r); })->size(), 100'000U);
  const api::MapUpload upload{"copy", {1, 2, 3}, true, true};
  EXPECT_EQ(ask<api::MapSummary>([&](auto r) { client->upload_map(upload, r); })->file_bytes, 3U);
  EXPECT_EQ(robot_.values().uploads, std::vector<api::MapUpload>{upload});
  EXPECT_TRUE(ask<void>([&](auto r) { client->relocalise(Pose2{1.0, 2.0, 0.5}, r); }));
  EXPECT_TRUE(ask<void>([&](auto r) { client->relocalise(std::nullopt, r); }));
  EXPECT_EQ(robot_.values().relocalisations, (std::vector<std::optional<Pose2>>{Pose2{1.0, 2.0, 0.5}, std::nullopt}));
  EXPECT_TRUE(ask<void>([&](auto r) { client->delete_map("office", r); }));
}

TEST_F(MapCallsTest, RefusalsKeepTheirCodeAndWrongNamesDoNotReachTheRobot) {
  start();
  const auto client = connect("tester");
  const auto unknown = ask<api::MapSummary>([&](auto r) { client->load_map("cellar", api::MapUse::kContinue, r); });
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error(), (Error{Errc::kNotFound, "there is no map 'cellar'; none has been saved yet"}));
  const std::size_t calls = robot_.values().calls.size();
  const auto wrong = ask<api::MapSummary>([&](auto r) { client->save_map("../etc", true, r); });
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, Errc::kInvalidArgument);
  EXPECT_EQ(robot_.values().calls.size(), calls);
  for (const Errc code : {Errc::kCorrupt, Errc::kUnsupportedVersion, Errc::kIo, Errc::kBusy, Errc::kTooLarge}) {
    robot_.edit([&](FakeRobotValues& v) { v.failure = Error{code, "the cause; the remedy"}; });
    const auto failed = ask<api::MapSummary>([&](auto r) { client->inspect_map("office", true, r); });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error(), (Error{code, "the cause; the remedy"}));
  }
}

TEST_F(MapCallsTest, ObserverLooksButChangesNothing) {
  params_.max_role = api::Role::kObserver;
  start();
  const auto client = connect("watcher");
  EXPECT_TRUE(ask<std::vector<api::MapSummary>>([&](auto r) { client->list_maps(r); }));
  EXPECT_TRUE(ask<api::SegmentUpdate>([&](auto r) { client->get_segments(0, r); }));
  EXPECT_EQ(ask<api::MapSummary>([&](auto r) { client->save_map("a", false, r); }).error().code, Errc::kRefused);
  EXPECT_EQ(ask<void>([&](auto r) { client->delete_map("a", r); }).error().code, Errc::kRefused);
  EXPECT_EQ(ask<void>([&](auto r) { client->relocalise(std::nullopt, r); }).error().code, Errc::kRefused);
}

TEST_F(MapCallsTest, MapOfManySegmentsArrivesWhole) {
  Rng rng(1);
  const LineMap map = random_map(rng, {.nodes = 3, .segments = 10'000, .keyframes = 0});
  robot_.edit([&](FakeRobotValues& v) { v.segments = api::SegmentUpdate{9, 2, true, map.segments, {}}; });
  start();
  const auto client = connect("tester");
  const auto segments = ask<api::SegmentUpdate>([&](auto r) { client->get_segments(0, r); });
  ASSERT_TRUE(segments) << segments.error().message;
  EXPECT_EQ(*segments, *robot_.values().segments);
}

TEST_F(MapCallsTest, SubscriberGetsTheMapFirstAndNoChangeThatIsOlder) {
  start();
  const auto client = connect("tester");
  Recorder<api::SegmentUpdate> seen;
  const auto subscription = client->subscribe({{api::Topic::kSegments, 0.0, 0}}, [&](const api::UpdatePtr& update) {
    seen.add(std::get<api::SegmentUpdate>(update->payload));
  });
  ASSERT_TRUE(subscription);
  ASSERT_TRUE(seen.wait_count(1));
  EXPECT_EQ(seen.items().front(), *robot_.values().segments);
  robot_.publish(api::Topic::kSegments, robot_time_s(1.0), change(2, 1));
  robot_.publish(api::Topic::kSegments, robot_time_s(1.1), change(4, 2));
  ASSERT_TRUE(seen.wait_count(2));
  EXPECT_EQ(seen.items().back(), change(4, 2)) << "revision 2 was part of what get_segments answered";
  api::SegmentUpdate late = *robot_.values().segments;
  late.revision = 3;
  robot_.publish(api::Topic::kSegments, robot_time_s(1.2), late);
  robot_.publish(api::Topic::kSegments, robot_time_s(1.3), change(5, 3));
  ASSERT_TRUE(seen.wait_count(3));
  EXPECT_EQ(seen.items().back(), change(5, 3)) << "an overtaken map must not replace a newer one";
}

}  // namespace
}  // namespace seeker::testing
