#include "server/app/fleet/fleet_judge.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

/// A judge on the thread of the test; the loop of the main robot hands `own` over, or nothing.
struct JudgeParts : BookParts {
  std::optional<LineMap> own = west();
  app::FleetJudge judge{fleet::MergeParams{}, seconds(10), book, main, [this](const api::Reply<app::OwnMap>& reply) {
                          if (own) {
                            reply(app::OwnMap{*own, Pose2{}});
                          } else {
                            reply(fail(Errc::kNotReady, "it waits for 'resume'"));
                          }
                        }};

  [[nodiscard]] api::FleetMember entry(std::size_t index = 1) const { return book.status(kStart).members.at(index); }
};

TEST(FleetJudge, JoinsTheMapsOfOneBuilding) {
  JudgeParts parts;
  parts.join(packed(east()));
  EXPECT_EQ(parts.judge.joint_map(), nullptr);
  parts.judge.judge("r1");
  EXPECT_EQ(parts.entry().state, api::FleetState::kMerged) << parts.entry().reason;
  EXPECT_THAT(*parts.entry().main_T_map, Pose2Near(west_T_east(), 0.15, 0.03));
  ASSERT_NE(parts.judge.joint_map(), nullptr);
  EXPECT_EQ(parts.judge.joint_map()->map.nodes.size(), west().nodes.size() + east().nodes.size());
  EXPECT_EQ(parts.entry(0).nodes, west().nodes.size());
  const app::JudgedFleet judged = parts.judge.judged();
  EXPECT_EQ(*judged.own_map, west());
  EXPECT_EQ(judged.own_version, 1U);
  EXPECT_EQ(judged.joint_epoch, 1U);
  EXPECT_EQ(judged.pairs.size(), 1U);
  ASSERT_TRUE(parts.book.decide({"r1", api::FleetVerb::kSplit, 0}, kStart));
  parts.judge.judge("r1");
  EXPECT_EQ(parts.judge.joint_map(), nullptr) << "nobody takes part any more";
}

TEST(FleetJudge, SaysWhyARobotWaits) {
  JudgeParts parts;
  parts.own.reset();
  parts.join(packed(small_map()));
  parts.judge.judge("r1");
  EXPECT_EQ(parts.entry().state, api::FleetState::kWaiting);
  EXPECT_NE(parts.entry().reason.find("the main robot has no map yet"), std::string::npos) << parts.entry().reason;
}

TEST(FleetJudge, TakesUpWhatWasFoundBeforeARestart) {
  JudgeParts before;
  before.join(packed(east()));
  before.judge.judge("r1");
  JudgeParts parts;
  parts.own.reset();
  parts.book.load(app::FleetSlots(before.book.slots()), {before.book.record_of("r1")});
  const app::JudgedFleet judged = before.judge.judged();
  parts.judge.recall({judged.joint_epoch, *judged.own_map, *judged.own_pictures, {}, {}, judged.pairs});
  EXPECT_EQ(parts.entry().state, api::FleetState::kMerged) << parts.entry().reason;
  EXPECT_TRUE(parts.main.remembered());
  ASSERT_NE(parts.judge.joint_map(), nullptr);
  EXPECT_GT(parts.judge.joint_map()->map.epoch, before.judge.joint_map()->map.epoch);
  parts.judge.judge("r1");
  EXPECT_EQ(parts.entry().state, api::FleetState::kMerged) << "the main robot has not taken up its map";
  EXPECT_TRUE(parts.main.remembered());
  parts.own = west();
  parts.judge.judge("r1");
  EXPECT_FALSE(parts.main.remembered());
  EXPECT_EQ(parts.entry().state, api::FleetState::kMerged);
}

TEST(FleetJudge, GoesOnCountingEpochsWhereTheRestOfTheMemoryIsLost) {
  JudgeParts parts;
  parts.judge.recall({7, std::nullopt, {}, {}, {}, {}});
  EXPECT_EQ(parts.judge.judged().joint_epoch, 7U);
  EXPECT_EQ(parts.judge.judged().own_version, 0U);
  EXPECT_FALSE(parts.main.remembered());
}

TEST(FleetJudge, DropsWhatWasFoundOfAMapThatTheMainRobotHasLeft) {
  JudgeParts parts;
  parts.join(packed(east()));
  parts.judge.judge("r1");
  static_cast<void>(parts.main.receive(app::OwnSeen{true, {}, {found_at(1, {1.0, 1.0})}, {}}, kStart));
  parts.own = fleet::toy_map(fleet::office(12), fleet::drive(kWest), 31);
  parts.judge.judge("r1");
  EXPECT_NE(parts.entry().state, api::FleetState::kMerged) << parts.entry().reason;
  EXPECT_TRUE(parts.entry(0).detections.empty()) << "that was in the frame of the map before";
}

}  // namespace
}  // namespace seeker::testing
