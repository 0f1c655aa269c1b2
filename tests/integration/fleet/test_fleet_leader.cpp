// What the main robot of a fleet makes of what others announce and send.

#include <future>

#include "common/digest/sha256.hpp"
#include "server/store/map_file.hpp"
#include "tests/integration/fleet/fleet_world.hpp"
#include "tests/integration/fleet/toy_robot.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::testing {
namespace {

using app::FleetLeader;
using app::FleetLeaderParams;
using app::PackedMap;

TEST(FleetPieces, AMapComesOutAsItWentIn) {
  const LineMap map = east();
  const PackedMap robot = packed(map);
  const Result<LineMap> again = app::unpack_map(robot.manifest, robot.pieces);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->nodes, map.nodes);
  EXPECT_EQ(again->edges, map.edges);
  EXPECT_EQ(again->keyframes, map.keyframes);
}

TEST(FleetPieces, APieceStaysTheSameWhenTheMapAroundItMoves) {
  LineMap map = east();
  const PackedMap before = packed(map);
  map.epoch = 1;
  map.nodes.back().map_T_node = map.nodes.back().map_T_node * Pose2{0.3, -0.1, 0.02};
  const PackedMap after = packed(map);
  for (std::size_t k = 0; k < map.nodes.size(); ++k) {
    EXPECT_EQ(before.manifest.nodes[k].hash, after.manifest.nodes[k].hash);
  }
}

TEST(FleetLeader, MergesARobotOfTheSameBuilding) {
  FleetLeader leader(leader_params("fleet_merge"), holds(west()));
  join(leader, packed(east()));
  const api::FleetMember member = until(leader, "r1", [](const auto& m) { return m.main_T_map.has_value(); });
  EXPECT_THAT(*member.main_T_map, Pose2Near(west_T_east(), 0.15, 0.03));
  EXPECT_GT(member.confidence, 0.5);
  std::promise<Result<std::vector<std::uint8_t>>> promise;
  leader.map([&](auto bytes) { promise.set_value(std::move(bytes)); });
  const auto bytes = promise.get_future().get();
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto joint = store::decode_map_file(*bytes);
  ASSERT_TRUE(joint) << joint.error().message;
  EXPECT_EQ(joint->map.nodes.size(), west().nodes.size() + east().nodes.size());
}

TEST(FleetLeader, KeepsARobotOfAnotherBuildingApart) {
  FleetLeader leader(leader_params("fleet_other"), holds(west()));
  join(leader, packed(east()));
  static_cast<void>(until(leader, "r1", api::FleetState::kMerged));
  join(leader, packed(east(12), "stranger", 2));
  const api::FleetMember stranger =
      until(leader, "stranger", [](const auto& m) { return m.state != api::FleetState::kWaiting; });
  EXPECT_NE(stranger.state, api::FleetState::kMerged) << stranger.reason;
  EXPECT_FALSE(stranger.main_T_map);
  EXPECT_EQ(until(leader, "r1", api::FleetState::kMerged).state, api::FleetState::kMerged);
}

TEST(FleetLeader, SplitTakesARobotOutAndMergeTakesItInAgain) {
  FleetLeader leader(leader_params("fleet_split"), holds(west()));
  join(leader, packed(east()));
  static_cast<void>(until(leader, "r1", api::FleetState::kMerged));
  const auto split = leader.decide({"r1", api::FleetVerb::kSplit, 0});
  ASSERT_TRUE(split);
  EXPECT_EQ(split->members[1].state, api::FleetState::kSplit);
  ASSERT_TRUE(leader.decide({"r1", api::FleetVerb::kMerge, 0}));
  static_cast<void>(until(leader, "r1", [](const auto& m) { return m.main_T_map.has_value(); }));
  EXPECT_EQ(leader.decide({"nobody", api::FleetVerb::kSplit, 0}).error().code, Errc::kNotFound);
  EXPECT_EQ(leader.decide({"r1", api::FleetVerb::kMerge, 9}).error().code, Errc::kRefused);
}

TEST(FleetLeader, RefusesANamesakeAndLeavesTheFirstAsItWas) {
  FleetLeaderParams patient = leader_params("fleet_namesake");
  patient.silence_limit = std::chrono::hours(1);
  FleetLeader leader(patient, holds(west()));
  const PackedMap first = packed(east(), "r1", 1);
  join(leader, first);
  EXPECT_EQ(leader.announce(packed(west(), "r1", 2).manifest).error().code, Errc::kRefused);
  EXPECT_EQ(leader.announce(packed(west(), "main", 3).manifest).error().code, Errc::kRefused);
  EXPECT_TRUE(leader.announce(first.manifest)->missing.empty());
}

TEST(FleetLeader, TakesOverAnIdWhoseRobotIsSilent) {
  FleetLeaderParams quick = leader_params("fleet_silent");
  quick.silence_limit = Duration::zero();
  FleetLeader leader(quick, holds(west()));
  join(leader, packed(east(), "r1", 1));
  EXPECT_TRUE(leader.announce(packed(east(), "r1", 2).manifest)) << "it was started anew";
}

TEST(FleetLeader, GoesOnWithAPieceWhereItWasCut) {
  FleetLeader leader(leader_params("fleet_resume"), holds(west()));
  const PackedMap robot = packed(east());
  const api::PieceHash hash = leader.announce(robot.manifest)->missing.front().hash;
  const std::vector<std::uint8_t>& bytes = *robot.pieces.at(hash);
  const auto half = static_cast<std::ptrdiff_t>(bytes.size() / 2);
  EXPECT_EQ(leader.receive({"r1", hash, 0, {bytes.begin(), bytes.begin() + half}}).value(), bytes.size() / 2);
  EXPECT_EQ(leader.announce(robot.manifest)->missing.front().offset, bytes.size() / 2);
  EXPECT_EQ(leader.receive({"r1", hash, 0, {bytes.begin(), bytes.end()}}).value(), bytes.size() / 2) << "sent twice";
  EXPECT_EQ(leader.receive({"r1", hash, bytes.size() / 2, {bytes.begin() + half, bytes.end()}}).value(), bytes.size());
}

TEST(FleetLeader, ThrowsAwayAPieceThatIsNotWhatItsHashSays) {
  FleetLeader leader(leader_params("fleet_corrupt"), holds(west()));
  const PackedMap robot = packed(east());
  const api::PieceHash hash = leader.announce(robot.manifest)->missing.front().hash;
  std::vector<std::uint8_t> altered = *robot.pieces.at(hash);
  altered.back() ^= 1U;
  EXPECT_EQ(leader.receive({"r1", hash, 0, altered}).error().code, Errc::kCorrupt);
  EXPECT_EQ(leader.announce(robot.manifest)->missing.front().offset, 0U);
  altered.push_back(0);
  EXPECT_EQ(leader.receive({"r1", hash, 0, altered}).error().code, Errc::kTooLarge);
  EXPECT_EQ(leader.receive({"r1", digest::sha256_of(altered), 0, altered}).error().code, Errc::kNotFound);
}

TEST(FleetLeader, ARobotThatLiesAboutItsPiecesIsNotMerged) {
  FleetLeader leader(leader_params("fleet_liar"), holds(west()));
  PackedMap liar = packed(east());
  const std::vector<std::uint8_t> noise(100, 7);
  liar.manifest.nodes.front().hash = digest::sha256_of(noise);
  liar.manifest.nodes.front().piece_bytes = noise.size();
  liar.pieces[liar.manifest.nodes.front().hash] = std::make_shared<const std::vector<std::uint8_t>>(noise);
  join(leader, liar);
  const api::FleetMember member =
      until(leader, "r1", [](const auto& m) { return m.reason.find("map file") != std::string::npos; });
  EXPECT_EQ(member.state, api::FleetState::kWaiting);
}

TEST(FleetLeader, ARestartLosesNothing) {
  const FleetLeaderParams same = leader_params("fleet_restart");
  {
    FleetLeader leader(same, holds(west()));
    join(leader, packed(east()));
    static_cast<void>(until(leader, "r1", api::FleetState::kMerged));
  }
  FleetLeader again(same, holds(west()));
  const api::FleetMember member = until(again, "r1", [](const auto& m) { return m.main_T_map.has_value(); });
  EXPECT_FALSE(member.linked) << "it has not announced itself to this run";
  EXPECT_TRUE(again.announce(packed(east(), "r1", 2).manifest)->missing.empty());
}

}  // namespace
}  // namespace seeker::testing
