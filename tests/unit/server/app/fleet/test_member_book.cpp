#include "server/app/fleet/member_book.hpp"

#include <thread>

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

TEST(MemberBook, AsksForAJudgementOnceAllPiecesOfAMapAreThere) {
  BookParts parts;
  const app::PackedMap robot = packed(small_map());
  const auto answer = parts.book.announce(robot.manifest, kStart);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->missing.size(), 2U);
  EXPECT_EQ(answer->fleet.members.size(), 2U);
  EXPECT_EQ(parts.asked.take("judge r1"), 0U);
  EXPECT_FALSE(parts.book.begin_judgement("r1", kStart)) << "pieces are missing";
  parts.join(robot);
  EXPECT_EQ(parts.asked.asked, std::vector<std::string>({"piece r1", "piece r1", "judge r1"}));
  const auto map = parts.book.begin_judgement("r1", kStart);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->slot, 1);
  EXPECT_EQ(map->manifest, robot.manifest);
  EXPECT_EQ(map->pieces.size(), 2U);
}

TEST(MemberBook, AsksAgainForTheSameMapOnlyAfterTheRetryPeriod) {
  BookParts parts({seconds(5), seconds(10)});
  const app::PackedMap robot = packed(small_map());
  parts.join(robot);
  parts.join(robot);
  EXPECT_EQ(parts.asked.take("judge r1"), 1U) << "the first judgement still waits";
  static_cast<void>(parts.book.begin_judgement("r1", kStart));
  parts.join(robot, kStart + seconds(10));
  EXPECT_EQ(parts.asked.take("judge r1"), 0U);
  parts.join(robot, kStart + seconds(11));
  EXPECT_EQ(parts.asked.take("judge r1"), 1U);
}

TEST(MemberBook, AsksAgainWhereTheQueueOfTheWorkerWasFull) {
  BookParts parts;
  parts.asked.full = true;
  parts.join(packed(small_map()));
  EXPECT_EQ(parts.asked.take("judge r1"), 1U);
  parts.asked.full = false;
  parts.join(packed(small_map()));
  EXPECT_EQ(parts.asked.take("judge r1"), 1U);
}

TEST(MemberBook, RefusesTheIdOfARobotThatIsThere) {
  BookParts parts;
  parts.join(packed(small_map(), "r1", 1));
  EXPECT_EQ(parts.book.announce(packed(small_map(), "r1", 2).manifest, kStart).error().code, Errc::kRefused);
  EXPECT_EQ(parts.book.announce(packed(small_map(), "main", 2).manifest, kStart).error().code, Errc::kRefused);
  EXPECT_TRUE(parts.book.announce(packed(small_map(), "r1", 2).manifest, kStart + seconds(5))) << "it was silent";
}

TEST(MemberBook, RefusesMoreThanAFleetHolds) {
  BookParts parts;
  for (std::size_t k = 1; k < api::kMaxFleetRobots; ++k) {
    ASSERT_TRUE(parts.book.announce(packed(small_map(1), "r" + std::to_string(k)).manifest, kStart));
  }
  EXPECT_EQ(parts.book.announce(packed(small_map(1), "last").manifest, kStart).error().code, Errc::kTooLarge);
  api::FleetManifest large = packed(small_map(1), "r1").manifest;
  large.nodes.front().piece_bytes = std::uint64_t{257} << 20U;
  EXPECT_EQ(parts.book.announce(large, kStart).error().code, Errc::kTooLarge);
}

TEST(MemberBook, HearsOnlyTheProgramThatHasAnnouncedItself) {
  BookParts parts;
  EXPECT_EQ(parts.book.receive(api::FleetShare{"r1", 1, {}}, kStart).error().code, Errc::kNotFound);
  EXPECT_EQ(parts.book.receive(seen_by("r1"), kStart).error().code, Errc::kNotFound);
  EXPECT_EQ(parts.book.receive({"r1", {}, 0, {1}}).error().code, Errc::kNotFound);
  parts.join(packed(small_map()));
  EXPECT_TRUE(parts.book.receive(api::FleetShare{"r1", 1, {}}, kStart));
  EXPECT_EQ(parts.book.receive(api::FleetShare{"r1", 2, {}}, kStart).error().code, Errc::kNotFound);
}

TEST(MemberBook, AsksForARecordWhenARobotHasFoundSomethingElse) {
  BookParts parts;
  parts.join(packed(small_map()));
  parts.asked.asked.clear();
  ASSERT_TRUE(parts.book.receive(seen_by("r1", {found_at(1, {1.0, 1.0})}), kStart));
  ASSERT_TRUE(parts.book.receive(seen_by("r1", {found_at(2, {1.0, 1.0})}), kStart));
  EXPECT_EQ(parts.asked.take("record r1"), 1U) << "one record waits";
  parts.book.begin_record("r1");
  ASSERT_TRUE(parts.book.receive(seen_by("r1", {found_at(2, {1.0, 1.0})}), kStart));
  EXPECT_EQ(parts.asked.take("record r1"), 0U);
  EXPECT_EQ(parts.book.record_of("r1").finds.now.front().id, 2U);
}

TEST(MemberBook, GivesAMergedRobotTheOthersInItsOwnFrame) {
  BookParts parts;
  parts.join(packed(small_map(), "r1"));
  parts.join(packed(small_map(2, 2), "r2"));
  app::JoinOutcome outcome = merged_at({10.0, 0.0, 0.0}, 1);
  const app::JoinOutcome second = merged_at({12.0, 0.0, 0.0}, 2);
  outcome.pairs.push_back(second.pairs.front());
  outcome.links.insert(second.links.begin(), second.links.end());
  outcome.main_T_maps->insert(second.main_T_maps->begin(), second.main_T_maps->end());
  EXPECT_TRUE(parts.book.receive(api::FleetShare{"r1", 1, {}}, kStart)->others.empty()) << "nothing is merged yet";
  parts.book.settle(outcome);
  const auto received = parts.book.receive(api::FleetShare{"r1", 1, at_place("r1", {2.0, 1.0})}, kStart);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->state, api::FleetState::kMerged);
  EXPECT_EQ(received->main_T_map, (Pose2{10.0, 0.0, 0.0}));
  ASSERT_EQ(received->others.size(), 1U);
  EXPECT_EQ(received->others.front().robot_id, "r2");
  EXPECT_THAT(received->others.front().map_T_theirs, Pose2Near(Pose2{2.0, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_TRUE(received->others.front().silent) << "it has not shared its topology";
  const auto merged = parts.book.merged(kStart);
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_FALSE(merged.front().silent);
  EXPECT_EQ(merged.front().map_T_theirs, (Pose2{10.0, 0.0, 0.0}));
}

TEST(MemberBook, RaisesItsRevisionAndTellsTheOperatorWithANewState) {
  BookParts parts;
  parts.join(packed(small_map()));
  const std::uint32_t before = parts.book.status(kStart).revision;
  parts.asked.asked.clear();
  parts.book.settle(apart_with(fleet::MergeVerdict::kAmbiguous));
  parts.book.settle(apart_with(fleet::MergeVerdict::kAmbiguous));
  EXPECT_EQ(parts.asked.take("event fleet-ambiguous"), 1U);
  EXPECT_EQ(parts.book.status(kStart).revision, before + 1);
  parts.book.settle(apart_with(fleet::MergeVerdict::kContradicted));
  EXPECT_EQ(parts.asked.take("event fleet-contradicted"), 1U);
}

TEST(MemberBook, LetsOnlyRobotsTakePartWhoseMapsAreJudged) {
  BookParts parts;
  parts.join(packed(small_map(), "r1"));
  parts.join(packed(small_map(2, 2), "r2"));
  const auto answer = answer_with(fleet::MergeVerdict::kMerged, {});
  const std::vector<fleet::PairAnswer> pairs{{0, 1, answer}, {0, 2, answer}, {1, 2, answer}, {0, 7, answer}};
  EXPECT_EQ(parts.book.taking_part(pairs).size(), 3U);
  EXPECT_EQ(parts.book.comparable_but(1), std::vector<std::uint8_t>({2}));
  parts.book.set_trouble("r2", "its pieces are no map");
  EXPECT_EQ(parts.book.taking_part(pairs).size(), 1U);
  EXPECT_TRUE(parts.book.comparable_but(1).empty());
  ASSERT_TRUE(parts.book.announce(packed(small_map(2, 9), "r1").manifest, kStart)) << "it begins a new map";
  EXPECT_TRUE(parts.book.taking_part(pairs).empty());
}

TEST(MemberBook, AppliesTheDecisionsOfTheOperator) {
  BookParts parts;
  parts.join(packed(small_map()));
  parts.book.settle(apart_with(fleet::MergeVerdict::kAmbiguous));
  EXPECT_EQ(parts.book.decide({"nobody", api::FleetVerb::kSplit, 0}, kStart).error().code, Errc::kNotFound);
  EXPECT_EQ(parts.book.decide({"r1", api::FleetVerb::kMerge, 9}, kStart).error().code, Errc::kRefused);
  const auto accepted = parts.book.decide({"r1", api::FleetVerb::kMerge, 0}, kStart);
  ASSERT_TRUE(accepted);
  EXPECT_TRUE(accepted->members[1].by_operator);
  EXPECT_EQ(parts.book.record_of("r1").accepted, (Pose2{1.0, 2.0, 0.0}));
  const auto pairs = parts.book.taking_part(apart_with(fleet::MergeVerdict::kAmbiguous).pairs);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_TRUE(pairs.front().answer.merged());
  ASSERT_TRUE(parts.book.decide({"r1", api::FleetVerb::kSplit, 0}, kStart));
  EXPECT_TRUE(parts.book.record_of("r1").split);
}

TEST(MemberBook, KeepsWhatAProgramFoundBeforeItWasRestarted) {
  BookParts parts;
  parts.join(packed(small_map(), "r1", 1));
  ASSERT_TRUE(parts.book.receive(seen_by("r1", {found_at(1, {1.0, 1.0})}), kStart));
  parts.join(packed(small_map(), "r1", 2), kStart + seconds(5));
  const app::MemberRecord record = parts.book.record_of("r1");
  EXPECT_TRUE(record.finds.now.empty());
  EXPECT_EQ(record.finds.before.size(), 1U);
}

TEST(MemberBook, IsTheSameAfterARestart) {
  BookParts parts;
  parts.join(packed(small_map(), "r1"));
  parts.join(packed(small_map(2, 2), "r2"));
  BookParts again;
  again.book.load(app::FleetSlots(parts.book.slots()), {parts.book.record_of("r2")});
  EXPECT_EQ(again.book.slots().at("r2"), 2);
  EXPECT_EQ(again.book.maps().size(), 1U);
  EXPECT_TRUE(again.asked.asked.empty());
  again.book.judge_complete();
  EXPECT_EQ(again.asked.take("judge r2"), 1U);
  again.join(packed(small_map(), "r1"));
  EXPECT_EQ(again.book.slots().at("r1"), 1) << "a robot keeps its number";
}

TEST(MemberBook, MayBeCalledByTheNetworkAndTheJudgeAtOnce) {
  BookParts parts;
  parts.join(packed(small_map()));
  std::thread judge([&] {
    for (int k = 0; k < 200; ++k) {
      static_cast<void>(parts.book.begin_judgement("r1", kStart));
      parts.book.settle(merged_at({static_cast<double>(k), 0.0, 0.0}));
    }
  });
  for (int k = 0; k < 200; ++k) {
    ASSERT_TRUE(parts.book.receive(api::FleetShare{"r1", 1, at_place("r1", {2.0, 1.0})}, kStart));
    EXPECT_EQ(parts.book.status(kStart).members.size(), 2U);
  }
  judge.join();
  EXPECT_EQ(parts.book.status(kStart).members[1].main_T_map, (Pose2{199.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace seeker::testing
