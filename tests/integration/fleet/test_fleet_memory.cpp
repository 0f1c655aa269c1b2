// What the main robot of a fleet knows again when its program was killed.

#include <algorithm>
#include <future>

#include "common/files/files.hpp"
#include "server/app/fleet/fleet_records.hpp"
#include "server/store/map_file.hpp"
#include "tests/integration/fleet/fleet_world.hpp"
#include "tests/integration/fleet/toy_robot.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::testing {
namespace {

using app::FleetLeader;
using app::FleetLeaderParams;

/// The joint map as clients get it.
LineMap joint_map(FleetLeader& leader) {
  std::promise<Result<std::vector<std::uint8_t>>> promise;
  leader.map([&](auto bytes) { promise.set_value(std::move(bytes)); });
  const auto bytes = promise.get_future().get();
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? store::decode_map_file(*bytes)->map : LineMap{};
}

/// Started anew, it has not taken its map up again.
app::FleetHost without_map(const ToyHost& received) {
  app::FleetHost host = received.host();
  host.give_map = [](const api::Reply<app::OwnMap>& reply) { reply(fail(Errc::kNotReady, "it waits for 'resume'")); };
  return host;
}

bool reported(const ToyHost& host, const std::string& kind) {
  const std::vector<std::string> events = host.events();
  return std::any_of(events.begin(), events.end(),
                     [&](const std::string& event) { return event.compare(0, kind.size(), kind) == 0; });
}

/// As the main robot has it after its first scan.
LineMap one_scan() {
  LineMap map = west();
  map.nodes.resize(1);
  map.edges.clear();
  map.keyframes.resize(1);
  map.nodes[0].created += std::chrono::hours(1);
  map.keyframes[0].stamp += std::chrono::hours(1);
  std::erase_if(map.segments, [&](const MapSegment& segment) { return segment.node != map.nodes[0].id; });
  return map;
}

class FleetMemory : public ::testing::Test {
 protected:
  void SetUp() override {
    FleetLeader leader(same, holds(west()));
    join(leader, packed(east(), "r2"));
    join(leader, packed(east(12), "stranger", 2));
    merged = until(leader, "r2", [](const auto& m) { return m.main_T_map.has_value(); });
    static_cast<void>(until(leader, "stranger", [](const auto& m) { return m.state != api::FleetState::kWaiting; }));
    ASSERT_TRUE(leader.decide({"stranger", api::FleetVerb::kSplit, 0}));
    ASSERT_TRUE(leader.seen(seen_by("r2", {found_at(5, {2.0, 0.5})})));
    joint = joint_map(leader);
  }
  FleetLeaderParams same = leader_params("fleet_memory");
  ToyHost received{LineMap{}};
  api::FleetMember merged;
  LineMap joint;
};

TEST_F(FleetMemory, TheJointMapIsThereBeforeTheMainRobotHasTakenUpItsOwn) {
  FleetLeader again(same, without_map(received));
  EXPECT_EQ(again.status().members.size(), 3U);
  const api::FleetMember member = until(again, "r2", api::FleetState::kMerged);
  ASSERT_TRUE(member.main_T_map);
  EXPECT_THAT(*member.main_T_map, Pose2Near(*merged.main_T_map, 1e-6, 1e-6));
  ASSERT_EQ(member.detections.size(), 1U) << "what it has found is not forgotten";
  EXPECT_THAT(*member.detections[0].position, Point2Near(*merged.main_T_map * Point2(2.0, 0.5), 1e-6));
  EXPECT_EQ(until(again, "stranger", api::FleetState::kSplit).state, api::FleetState::kSplit);
  const LineMap map = joint_map(again);
  EXPECT_EQ(map.nodes.size(), joint.nodes.size());
  EXPECT_GT(map.epoch, joint.epoch);
  for (std::size_t k = 0; k < std::min(map.nodes.size(), joint.nodes.size()); ++k) {
    EXPECT_EQ(map.nodes[k].id, joint.nodes[k].id) << "the robots keep their numbers";
  }
}

TEST_F(FleetMemory, AMapOfOneScanDoesNotReplaceTheOneThatWasBuilt) {
  FleetLeader again(same, holds(one_scan()));
  join(again, packed(east(), "r2", 3));
  EXPECT_EQ(until(again, "r2", api::FleetState::kMerged).nodes, merged.nodes);
  EXPECT_EQ(again.status().members.front().nodes, west().nodes.size());
}

TEST_F(FleetMemory, AMapThatHasLostItsNewestPartStaysMerged) {
  LineMap shorter = west();
  const std::uint32_t last = shorter.nodes.back().id;
  ASSERT_GT(shorter.nodes.size(), 2U);
  std::erase_if(shorter.nodes, [&](const MapNode& node) { return node.id == last; });
  std::erase_if(shorter.edges, [&](const MapEdge& edge) { return edge.from == last || edge.to == last; });
  std::erase_if(shorter.segments, [&](const MapSegment& segment) { return segment.node == last; });
  std::erase_if(shorter.keyframes, [&](const MapKeyframe& keyframe) { return keyframe.node == last; });
  FleetLeader again(same, holds(shorter));
  const api::FleetMember member = until(again, "r2", [&](const auto& m) {
    return m.main_T_map && again.status().members.front().nodes == shorter.nodes.size();
  });
  EXPECT_THAT(*member.main_T_map, Pose2Near(west_T_east(), 0.15, 0.03));
}

TEST_F(FleetMemory, ADamagedMemoryIsToldAndFoundAnew) {
  ASSERT_TRUE(files::write_file(same.folder / "memory", "garbage"));
  const ToyHost host(west());
  FleetLeader again(same, host.host());
  EXPECT_THAT(*until(again, "r2", [](const auto& m) { return m.main_T_map.has_value(); }).main_T_map,
              Pose2Near(west_T_east(), 0.15, 0.03));
  EXPECT_TRUE(reported(host, "fleet-memory-damaged"));
}

TEST_F(FleetMemory, ADamagedRecordIsToldAndTheOthersStay) {
  ASSERT_TRUE(files::write_file(same.folder / "stranger" / "record", "garbage"));
  const ToyHost host(west());
  FleetLeader again(same, host.host());
  EXPECT_EQ(again.status().members.size(), 2U);
  EXPECT_TRUE(reported(host, "fleet-memory-damaged"));
  EXPECT_TRUE(until(again, "r2", [](const auto& m) { return m.main_T_map.has_value(); }).main_T_map);
}

/// Ids of what the main robot, or another one, has found.
std::vector<std::uint64_t> found_by(const FleetLeader& leader, const std::string& robot_id) {
  std::vector<std::uint64_t> ids;
  for (const api::FleetMember& member : leader.status().members) {
    for (const api::Detection& one : member.robot_id == robot_id ? member.detections : std::vector<api::Detection>()) {
      ids.push_back(one.id);
    }
  }
  return ids;
}

using Ids = std::vector<std::uint64_t>;

TEST_F(FleetMemory, AProgramThatRunsOnMayTakeBackWhatItHasFoundAnEndedOneMayNot) {
  same.silence_limit = Duration::zero();
  FleetLeader again(same, without_map(received));
  static_cast<void>(until(again, "r2", api::FleetState::kMerged));
  ASSERT_TRUE(again.announce(packed(east(), "r2", 1).manifest));
  ASSERT_TRUE(again.seen(seen_by("r2", {found_at(6, {2.0, 0.5})})));
  EXPECT_EQ(found_by(again, "r2"), Ids({6}));
  ASSERT_TRUE(again.announce(packed(east(), "r2", 3).manifest));
  ASSERT_TRUE(again.seen(seen_by("r2", {found_at(7, {2.0, 0.5})}, {}, 3)));
  EXPECT_EQ(found_by(again, "r2"), Ids({6, 7}));
}

TEST_F(FleetMemory, WhatTheMainRobotHasFoundSurvivesItsRestartButNotANewMap) {
  same.silence_limit = same.floor_period = Duration::zero();
  const auto tells = [](FleetLeader& leader, const Ids& ids) {
    return [&leader, ids](const api::FleetMember&) {
      leader.refresh();
      return found_by(leader, "main") == ids;
    };
  };
  {
    const ToyHost host(west(), std::nullopt, {true, {}, {found_at(7, {4.0, 0.5})}, {}});
    FleetLeader leader(same, host.host());
    static_cast<void>(until(leader, "main", tells(leader, {7})));
  }
  {
    FleetLeader again(same, without_map(received));
    static_cast<void>(until(again, "r2", api::FleetState::kMerged));
    EXPECT_EQ(found_by(again, "main"), Ids({7})) << "before it has taken up its map";
  }
  {
    const ToyHost host(west(), std::nullopt, {true, {}, {found_at(9, {4.0, 0.5})}, {}});
    FleetLeader again(same, host.host());
    static_cast<void>(until(again, "main", tells(again, {7, 9})));
    join(again, packed(east(), "r2", 3));
    static_cast<void>(until(again, "r2", api::FleetState::kMerged));
    const auto heard_by_r2 = again.seen(seen_by("r2", {}, {}, 3));
    ASSERT_TRUE(heard_by_r2) << heard_by_r2.error().message;
    EXPECT_EQ(heard_by_r2->findings.size(), 2U);
  }
  FleetLeader elsewhere(same, holds(fleet::toy_map(fleet::office(1), fleet::drive(kWest), 31)));
  static_cast<void>(joint_map(elsewhere));  // comes after all that was asked of the worker before
  EXPECT_EQ(found_by(elsewhere, "main"), Ids());
}

TEST(FleetRecords, AnAnswerComesOutAsItWentIn) {
  fleet::PreparedMap a;
  fleet::PreparedMap b;
  ASSERT_TRUE(a.update(west()));
  ASSERT_TRUE(b.update(east()));
  const fleet::MergeAnswer answer = fleet::MapMerger().merge(a, b);
  v1::KeptPair message;
  app::write(answer, &message);
  const Result<fleet::MergeAnswer> again = app::read_answer(message);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->verdict, answer.verdict);
  ASSERT_EQ(again->hypotheses.size(), answer.hypotheses.size());
  EXPECT_EQ(again->hypotheses[0].a_T_b.a_T_b, answer.hypotheses[0].a_T_b.a_T_b);
  EXPECT_EQ(again->hypotheses[0].a_T_b.covariance, answer.hypotheses[0].a_T_b.covariance);
  ASSERT_EQ(again->hypotheses[0].pairs.size(), answer.hypotheses[0].pairs.size());
  EXPECT_EQ(again->hypotheses[0].pairs[0].a_T_b.a_T_b, answer.hypotheses[0].pairs[0].a_T_b.a_T_b);
  EXPECT_EQ(again->confidence(), answer.confidence());
  message.set_verdict(9);
  EXPECT_EQ(app::read_answer(message).error().code, Errc::kInvalidArgument);
  message.set_verdict(4);
  message.mutable_hypotheses(0)->mutable_pose()->clear_covariance();
  EXPECT_EQ(app::read_answer(message).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::testing
