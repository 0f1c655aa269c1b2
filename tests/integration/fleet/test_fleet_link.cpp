// Robots that join a main one over loopback.

#include "common/net/exchange.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"
#include "tests/integration/fleet/fleet_world.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/net/chaos_proxy.hpp"

namespace seeker::testing {
namespace {

using namespace std::chrono_literals;

/// A main robot and the port that it is reached at.
struct Main {
  explicit Main(const std::string& name, const ToyHost& host = ToyHost(west())) {
    app::FleetSettings settings;
    settings.lead = true;
    settings.port = 0;
    settings.share_period = settings.floor_period = 20ms;
    const std::filesystem::path folder = fresh_folder(name);
    auto started = app::start_fleet(settings, "main", "test", folder, host.host());
    EXPECT_TRUE(started) << started.error().message;
    part = std::move(*started);
    port = static_cast<std::uint16_t>(std::stoi(wait_for_file(folder / "port", seconds(10)).value()));
  }
  app::FleetPart part;
  std::uint16_t port = 0;
};

app::FleetPart robot_at(std::uint16_t port, const std::string& robot_id, const app::FleetHost& host) {
  app::FleetSettings settings;
  settings.join = "127.0.0.1:" + std::to_string(port);
  settings.period = 20ms;
  settings.share_period = settings.floor_period = 20ms;
  auto started = app::start_fleet(settings, robot_id, "test", {}, host);
  EXPECT_TRUE(started) << started.error().message;
  return std::move(*started);
}

TEST(FleetLink, ARobotThatJoinsHearsWhereItIs) {
  const Main main("link_join");
  const app::FleetPart robot = robot_at(main.port, "r1", holds(east()));
  static_cast<void>(until(*main.part.leader, "r1", [](const auto& m) { return m.main_T_base.has_value(); }));
  std::optional<Pose2> received;
  while (!received) {
    const Result<api::FleetStatus> status = robot.follower->status();
    if (status && status->members.size() == 2) {
      received = status->members[1].main_T_map;
      EXPECT_FALSE(status->members[0].robot_id.empty());
    }
    std::this_thread::yield();
  }
  EXPECT_THAT(*received, Pose2Near(west_T_east(), 0.15, 0.03));
}

TEST(FleetLink, ALinkThatIsCutAllTheTimeStillBringsEverything) {
  const Main main("link_cut");
  ChaosProxy proxy(main.port);
  const app::FleetPart robot = robot_at(proxy.port(), "r1", holds(east()));
  std::size_t cuts = 0;
  const api::FleetMember member = until(*main.part.leader, "r1", [&](const api::FleetMember& m) {
    if (cuts < 20 && proxy.connections() > 0) {
      proxy.cut();
      ++cuts;
    }
    return m.main_T_map.has_value();
  });
  EXPECT_EQ(member.pieces_missing, 0U);
  EXPECT_GT(cuts, 0U);
}

bool is_active(const std::optional<FleetView>& view) {
  return view && !view->others.empty() && view->others.front().active;
}

TEST(FleetLink, ARobotKeepsThePlacesOfTheOthersWhenTheLinkDropsAndTakesUpTheirGoals) {
  const ToyHost first(west(), at_place("main", {2.0, 1.0}));
  const ToyHost second(east(), at_place("r1", {1.0, 0.0}));
  std::optional<Main> main(std::in_place, "link_share", first);
  const app::FleetPart robot = robot_at(main->port, "r1", second.host());
  const auto received = second.until(is_active);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->robot_id, "r1");
  EXPECT_THAT(received->others.front().map_T_base.translation(),
              Point2Near(inverse(west_T_east()) * Point2(2.0, 1.0), 0.3));
  const auto main_heard = first.until(is_active);
  ASSERT_TRUE(main_heard);
  EXPECT_EQ(main_heard->others.front().robot_id, "r1");
  main.reset();
  const auto alone = second.until([](const auto& view) { return view && !view->others.front().active; });
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->others.front().topology.nodes.size(), received->others.front().topology.nodes.size());
}

TEST(FleetLink, RobotsHearOfTheFloorAndTheTargetsThatTheOthersHaveSeen) {
  const Point2 seen_by_main(4.0, 0.5);
  const ToyHost first(west(), at_place("main", {2.0, 1.0}), {true, floor_with(seen_by_main), {}, {}});
  const ToyHost second(east(), at_place("r1", {1.0, 0.0}),
                       {true, floor_with({2.0, -0.5}), {found_at(1, {2.0, -0.5})}, {}});
  const Main main("link_floor", first);
  const app::FleetPart robot = robot_at(main.port, "r1", second.host());
  const auto has_floor = [](const std::optional<FleetView>& view) { return view && view->floor; };
  const auto received = second.until(has_floor);
  ASSERT_TRUE(received);
  const auto there = occupied_in(*received->floor);
  ASSERT_TRUE(there);
  EXPECT_THAT(*there, Point2Near(inverse(west_T_east()) * seen_by_main, 0.3));
  EXPECT_TRUE(first.until(has_floor));
  const auto events = first.events();
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const std::string& event) {
    return event.find("'r1' has seen 'mug'") != std::string::npos;
  }));
}

TEST(FleetLink, ARobotThatIsTakenOutForgetsTheOthers) {
  const ToyHost first(west(), at_place("main", {2.0, 1.0}));
  const ToyHost second(east(), at_place("r1", {1.0, 0.0}));
  const Main main("link_split", first);
  const app::FleetPart robot = robot_at(main.port, "r1", second.host());
  static_cast<void>(second.until(is_active));
  ASSERT_TRUE(main.part.leader->decide({"r1", api::FleetVerb::kSplit, 0}));
  static_cast<void>(second.until([](const auto& view) { return !view; }));
  static_cast<void>(first.until([](const auto& view) { return !view; }));
}

TEST(FleetLink, ARobotWithoutItsMainOneGoesOnAndSaysWhy) {
  std::uint16_t port = 0;
  {
    const Main main("link_gone");
    port = main.port;
  }
  const app::FleetPart robot = robot_at(port, "r1", holds(east()));
  Result<api::FleetStatus> status = robot.follower->status();
  while (!status && status.error().code == Errc::kNotReady) {
    status = robot.follower->status();
  }
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kLinkLost) << status.error().message;
}

v1::FleetReply ask(std::uint16_t port, const v1::FleetRequest& request) {
  auto exchange = net::Exchange::connect({"127.0.0.1", port, 10s, std::nullopt});
  EXPECT_TRUE(exchange);
  const Result<std::string> payload = (*exchange)->ask(request.SerializeAsString(), 10s);
  EXPECT_TRUE(payload) << payload.error().message;
  v1::FleetReply reply;
  EXPECT_TRUE(wire::parse_within_limits(*payload, reply));
  return reply;
}

TEST(FleetServer, RefusesAnotherProtocolAndNonsense) {
  const Main main("link_hostile");
  v1::FleetRequest request;
  request.set_protocol(9);
  request.set_status(true);
  EXPECT_EQ(wire::status_of(ask(main.port, request).error()).error().code, Errc::kUnsupportedVersion);
  request.set_protocol(wire::kFleetProtocol);
  EXPECT_TRUE(wire::status_of(ask(main.port, request).error()));
  request.mutable_announce()->set_robot_id("../../etc");
  EXPECT_EQ(wire::status_of(ask(main.port, request).error()).error().code, Errc::kInvalidArgument);
  request.clear_call();
  EXPECT_EQ(wire::status_of(ask(main.port, request).error()).error().code, Errc::kInvalidArgument);
  auto garbage = net::Exchange::connect({"127.0.0.1", main.port, 10s, std::nullopt});
  ASSERT_TRUE(garbage);
  EXPECT_EQ((*garbage)->ask("\x01\x02\x03 no message", 10s).error().code, Errc::kLinkLost);
  EXPECT_EQ(main.part.leader->status().members.size(), 1U);
}

TEST(FleetPart, LeadsOrJoinsButNotBoth) {
  app::FleetSettings settings;
  settings.lead = true;
  settings.join = "127.0.0.1:1";
  EXPECT_EQ(app::start_fleet(settings, "r", "test", {}, holds(west())).error().code, Errc::kInvalidArgument);
  settings = {};
  settings.join = "not an address:::";
  EXPECT_EQ(app::start_fleet(settings, "r", "test", {}, holds(west())).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::testing
