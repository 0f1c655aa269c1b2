#include "server/app/fleet/member_standing.hpp"

#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

using app::JoinOutcome;
using app::MemberStanding;

const Pose2 kPose{1.0, 2.0, 0.5};
const std::map<std::uint8_t, std::string> kNames{{1, "r1"}, {2, "r2"}};

TEST(MemberStanding, IsMergedAtThePoseOfTheMapJoin) {
  MemberStanding standing;
  EXPECT_EQ(standing.state(), api::FleetState::kWaiting);
  EXPECT_TRUE(standing.settle(1, merged_at(kPose), kNames));
  EXPECT_EQ(standing.state(), api::FleetState::kMerged);
  EXPECT_EQ(standing.main_T_map(), kPose);
  EXPECT_FALSE(standing.settle(1, merged_at({}), kNames)) << "the state is the same";
  api::FleetMember out;
  standing.describe(out);
  EXPECT_EQ(out.main_T_map, Pose2{});
  EXPECT_EQ(out.hypotheses.size(), 1U);
  EXPECT_EQ(out.confidence, 0.9) << "that of the link";
  EXPECT_EQ(out.merged_with, (api::FleetMergedWith{"", 0})) << "with the map of the main robot";
}

TEST(MemberStanding, FollowsTheVerdictOfItsPairWhereNoLinkLeadsToIt) {
  const std::vector<std::pair<fleet::MergeVerdict, api::FleetState>> states{
      {fleet::MergeVerdict::kAmbiguous, api::FleetState::kAmbiguous},
      {fleet::MergeVerdict::kContradicted, api::FleetState::kContradicted},
      {fleet::MergeVerdict::kInsufficientOverlap, api::FleetState::kInsufficientOverlap}};
  for (const auto& [verdict, state] : states) {
    MemberStanding standing;
    EXPECT_TRUE(standing.settle(1, apart_with(verdict), kNames));
    EXPECT_EQ(standing.state(), state);
    EXPECT_FALSE(standing.main_T_map());
  }
}

/// Robots 1 and 2 share what the main robot and robot 1 do not: the pair of those two speaks for itself only.
JoinOutcome merged_over_another() {
  JoinOutcome outcome = merged_at(kPose);
  outcome.links.at(1).through = 2;
  outcome.pairs.front().answer = answer_with(fleet::MergeVerdict::kInsufficientOverlap, kPose);
  outcome.pairs.front().answer.reason = "too little to be sure";
  outcome.pairs.push_back({1, 2, answer_with(fleet::MergeVerdict::kMerged, kPose)});
  outcome.pairs.back().answer.hypotheses.front().pictures.alike = 3;
  return outcome;
}

TEST(MemberStanding, NamesTheRobotOverWhoseMapItIsMergedAndWhatSpeaksForThat) {
  MemberStanding standing;
  EXPECT_TRUE(standing.settle(1, merged_over_another(), kNames));
  EXPECT_NE(standing.reason().find("'r2'"), std::string::npos) << standing.reason();
  EXPECT_NE(standing.reason().find("as the test says"), std::string::npos) << standing.reason();
  api::FleetMember out;
  standing.describe(out);
  EXPECT_EQ(out.merged_with, (api::FleetMergedWith{"r2", 3}));
}

TEST(MemberStanding, IsMergedWithNoneOnceItsMapIsANewOne) {
  MemberStanding standing;
  ASSERT_TRUE(standing.settle(1, merged_at(kPose), kNames));
  standing.begin_new_map();
  api::FleetMember out;
  standing.describe(out);
  EXPECT_FALSE(out.merged_with);
}

TEST(MemberStanding, IsAmbiguousWhereTheMapJoinLeftItOut) {
  JoinOutcome outcome = merged_at(kPose);
  outcome.main_T_maps->clear();
  MemberStanding standing;
  EXPECT_TRUE(standing.settle(1, outcome, kNames));
  EXPECT_EQ(standing.state(), api::FleetState::kAmbiguous);
  outcome.main_T_maps.reset();
  outcome.trouble = "the maps could not be joined";
  EXPECT_FALSE(standing.settle(1, outcome, kNames));
  EXPECT_EQ(standing.reason(), outcome.trouble);
}

TEST(MemberStanding, WaitsWhileItsMapCannotBeJudged) {
  MemberStanding standing;
  standing.set_trouble("a piece is none");
  EXPECT_FALSE(standing.comparable());
  EXPECT_FALSE(standing.settle(1, merged_at(kPose), kNames));
  EXPECT_EQ(standing.reason(), "a piece is none");
}

TEST(MemberStanding, OfANewMapTakesPartOnlyAfterItsJudgementHasBegun) {
  MemberStanding standing;
  ASSERT_TRUE(standing.settle(1, merged_at(kPose), kNames));
  standing.begin_new_map();
  EXPECT_EQ(standing.state(), api::FleetState::kWaiting);
  EXPECT_TRUE(standing.comparable());
  EXPECT_FALSE(standing.takes_part());
  standing.begin_judgement();
  EXPECT_TRUE(standing.takes_part());
}

TEST(MemberStanding, IsSplitUntilTheOperatorTakesItInAgain) {
  MemberStanding standing;
  ASSERT_TRUE(standing.settle(1, merged_at(kPose), kNames));
  ASSERT_TRUE(standing.decide({"r1", api::FleetVerb::kSplit, 0}));
  EXPECT_EQ(standing.state(), api::FleetState::kSplit);
  EXPECT_FALSE(standing.comparable());
  EXPECT_FALSE(standing.settle(1, merged_at(kPose), kNames));
  EXPECT_EQ(standing.reason(), app::kSplitReason);
  standing.begin_new_map();
  EXPECT_EQ(standing.state(), api::FleetState::kSplit) << "a new map does not take it in";
  ASSERT_TRUE(standing.decide({"r1", api::FleetVerb::kMerge, 0})) << "there is no hypothesis, and none is needed";
  EXPECT_FALSE(standing.split());
  EXPECT_FALSE(standing.accepted());
  EXPECT_TRUE(MemberStanding(true, std::nullopt).split()) << "as it was before a restart";
}

TEST(MemberStanding, TakesTheHypothesisThatTheOperatorHasAccepted) {
  MemberStanding standing;
  ASSERT_TRUE(standing.settle(1, apart_with(fleet::MergeVerdict::kAmbiguous), kNames));
  EXPECT_EQ(standing.decide({"r1", api::FleetVerb::kMerge, 9}).error().code, Errc::kRefused);
  ASSERT_TRUE(standing.decide({"r1", api::FleetVerb::kMerge, 0}));
  EXPECT_EQ(standing.accepted(), (Pose2{1.0, 2.0, 0.0}));
  fleet::MergeAnswer answer = answer_with(fleet::MergeVerdict::kAmbiguous, {9.0, 9.0, 0.0});
  answer.hypotheses.push_back(answer_with(fleet::MergeVerdict::kAmbiguous, {1.1, 2.0, 0.0}).hypotheses.front());
  standing.apply_acceptance(answer);
  EXPECT_TRUE(answer.merged());
  EXPECT_EQ(answer.hypotheses.front().a_T_b.a_T_b.x_m, 1.1);
  EXPECT_TRUE(standing.accepted());
}

TEST(MemberStanding, DropsAnAcceptanceThatTheMapsDeny) {
  MemberStanding standing(false, Pose2{1.0, 2.0, 0.0});
  fleet::MergeAnswer answer = answer_with(fleet::MergeVerdict::kAmbiguous, {9.0, 9.0, 0.0});
  standing.apply_acceptance(answer);
  EXPECT_EQ(answer.verdict, fleet::MergeVerdict::kContradicted);
  EXPECT_FALSE(standing.accepted());
}

TEST(MemberStanding, NeedsNoAcceptanceForWhatIsCertain) {
  MemberStanding standing;
  ASSERT_TRUE(standing.settle(1, merged_at(kPose), kNames));
  ASSERT_TRUE(standing.decide({"r1", api::FleetVerb::kMerge, 0}));
  EXPECT_FALSE(standing.accepted());
  EXPECT_EQ(standing.state(), api::FleetState::kWaiting) << "it is judged once more";
}

}  // namespace
}  // namespace seeker::testing
