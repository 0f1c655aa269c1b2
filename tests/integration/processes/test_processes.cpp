// Server and client as two processes over real sockets.

#include <array>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <future>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/rpc/wait.hpp"
#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

std::string target_file() { return source_file("config/targets/cross.yaml"); }

TEST(Processes, SearchOverTheWireFindsTheTargetAndSavesThePicture) {
  const Daemon daemon;
  std::string output;
  const std::string prefix = daemon.folder() / "map";
  EXPECT_EQ(seeker(daemon, {"search", "--target", target_file(), "--save", prefix}, &output), 0) << output;
  EXPECT_NE(output.find("TARGET_FOUND"), std::string::npos) << output;
  EXPECT_TRUE(std::filesystem::exists(prefix + ".png"));
  EXPECT_EQ(seeker(daemon, {"map", "export", daemon.folder() / "office"}, &output), 0) << output;
  for (const char* ending : {".pgm", ".yaml", ".png"}) {
    EXPECT_TRUE(std::filesystem::exists(daemon.folder() / ("office" + std::string(ending)))) << ending;
  }
}

TEST(Processes, EveryReportVerbAnswersWithJson) {
  const Daemon daemon;
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{
           {"status"}, {"components"}, {"detections"}, {"camera", "grab", "--out", daemon.folder() / "view.png"}}) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--json");
    std::string output;
    EXPECT_EQ(seeker(daemon, arguments, &output), 0) << verb.front() << ": " << output;
    EXPECT_TRUE(output.starts_with('{') || output.starts_with('[')) << output;
  }
}

TEST(Processes, RefusalsHaveTheirExitCodes) {
  const Daemon daemon;
  EXPECT_EQ(seeker(daemon, {"no-such-verb"}), 2);
  EXPECT_EQ(seeker(daemon, {"estop"}), 0);
  std::string output;
  EXPECT_EQ(seeker(daemon, {"search", "--target", target_file()}, &output), 3) << output;
  EXPECT_NE(output.find("estop --release"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"estop", "--release"}), 0);
  EXPECT_EQ(seeker(daemon, {"drive", "0.2", "0", "--for", "1"}, &output), 3) << output;
  ChildProcess nobody(program("seeker"), {"status", "--robot", "127.0.0.1:1", "--timeout", "2"},
                      daemon.folder() / "nobody");
  EXPECT_EQ(nobody.wait(seconds(30)), 4);
}

TEST(Processes, ClientKilledInTheMissionLetsItsLinkPolicyDecide) {
  // Slow enough that the mission outlives the grace of 5 s, fast enough for a test.
  const Daemon daemon({"--set", "sim.speed=4", "--set", "loop.mission.link_grace_s=1"});
  const auto watcher = connect(daemon, "watcher");
  std::promise<api::MissionStatus> ended;
  std::once_flag once;
  auto subscription = watcher->subscribe({{.topic = api::Topic::kMission}}, [&](const api::UpdatePtr& update) {
    const auto& status = std::get<api::MissionStatus>(update->payload);
    if (status.end) {
      std::call_once(once, [&] { ended.set_value(status); });
    }
  });
  ASSERT_TRUE(subscription);
  ChildProcess client(program("seeker"),
                      {"search", "--target", target_file(), "--link-policy", "stop", "--robot", daemon.address()},
                      daemon.folder() / "victim");
  const auto running = [&] {
    const Result<api::RobotStatus> status =
        rpc::wait<api::RobotStatus>([&](auto reply) { watcher->get_status(std::move(reply)); }, kCall);
    return status && status->mission && status->mission->path_length_m > 0.1;
  };
  while (!running()) {
  }
  client.send(SIGKILL);
  auto future = ended.get_future();
  ASSERT_EQ(future.wait_for(seconds(60)), std::future_status::ready);
  EXPECT_EQ(future.get().end->outcome, api::Outcome::kLinkLost);
}

TEST(Processes, ServerKilledInTheMissionOffersItAgainAndStaysDisarmed) {
  const std::filesystem::path folder = fresh_folder("crash");
  {
    Daemon daemon({"--set", "sim.speed=2"}, folder);
    EXPECT_EQ(seeker(daemon, {"search", "--target", target_file(), "--detach"}), 0);
    std::string output;
    while (output.find("RUNNING") == std::string::npos) {
      seeker(daemon, {"status", "--json"}, &output);
    }
    daemon.kill();
  }
  Daemon again({}, folder);
  const auto client = connect(again, "operator");
  const Result<api::RobotStatus> status =
      rpc::wait<api::RobotStatus>([&](auto reply) { client->get_status(std::move(reply)); }, kCall);
  ASSERT_TRUE(status);
  EXPECT_FALSE(status->motors_armed);
  EXPECT_FALSE(status->mission.has_value());
  ASSERT_TRUE(status->cut_off);
  EXPECT_EQ(status->cut_off->kind, "search");
  const Status resumed = rpc::wait<void>(
      [&](auto reply) { client->command_mission(api::MissionCommand::kResume, std::move(reply)); }, kCall);
  EXPECT_TRUE(resumed) << resumed.error().message;
}

TEST(Processes, CountdownOfALinkPolicyIsSeenWhileItsClientIsSilent) {
  const Daemon daemon({"--set", "sim.speed=1"});
  const auto watcher = connect(daemon, "watcher");
  const auto status = [&] {
    return rpc::wait<api::RobotStatus>([&](auto reply) { watcher->get_status(std::move(reply)); }, kCall)
        .value_or(api::RobotStatus{});
  };
  ChildProcess client(
      program("seeker"),
      {"search", "--target", target_file(), "--link-policy", "2:event,600:pause", "--robot", daemon.address()},
      daemon.folder() / "silent");
  while (!status().mission) {
  }
  EXPECT_FALSE(status().link_countdown);
  client.send(SIGSTOP);
  api::RobotStatus seen;
  while (!seen.link_countdown || !seen.link_countdown->next ||
         seen.link_countdown->next->action != api::LinkAction::kPause) {
    seen = status();
  }
  EXPECT_GE(seen.link_countdown->silent, Duration(seconds(2)));
  EXPECT_NEAR(to_seconds(seen.link_countdown->silent + seen.link_countdown->left), 600.0, 1e-6);
  EXPECT_EQ(seen.mission->link_steps.size(), 2U);
  std::string output;
  EXPECT_EQ(seeker(daemon, {"status"}, &output), 0);
  EXPECT_NE(output.find(", pause in 5"), std::string::npos) << output;
  client.send(SIGCONT);
  while (status().link_countdown) {
  }
  EXPECT_FALSE(status().mission->end);
  client.send(SIGINT);
  EXPECT_EQ(client.wait(seconds(60)), 130) << client.output();
}

TEST(Processes, EmergencyStopOutlivesAKilledServerUntilItIsReleased) {
  const std::filesystem::path folder = fresh_folder("estop");
  const auto latched = [](const Daemon& daemon) {
    const auto client = connect(daemon, "watcher");
    const auto status = rpc::wait<api::RobotStatus>([&](auto reply) { client->get_status(std::move(reply)); }, kCall);
    EXPECT_TRUE(status);
    return status && status->estop;
  };
  {
    Daemon daemon({}, folder);
    EXPECT_FALSE(latched(daemon));
    EXPECT_EQ(seeker(daemon, {"estop"}), 0);
    daemon.kill();
  }
  {
    Daemon again({}, folder);
    EXPECT_TRUE(latched(again));
    std::string output;
    EXPECT_EQ(seeker(again, {"goto", "1,0"}, &output), 3);
    EXPECT_NE(output.find("estop --release"), std::string::npos) << output;
    EXPECT_EQ(seeker(again, {"estop", "--release"}), 0);
    again.kill();
  }
  Daemon last({}, folder);
  EXPECT_FALSE(latched(last));
}

TEST(Processes, OwnerOfTheLeaseIsAskedAndGrantsIt) {
  const Daemon daemon({"--set", "loop.safety.lease_request_timeout_s=300"});
  ChildProcess anna(program("seeker"), {"--as", "anna", "lease", "acquire", "--robot", daemon.address()},
                    daemon.folder() / "anna");
  const auto watcher = connect(daemon, "watcher");
  const auto lease = [&] {
    const auto status = rpc::wait<api::RobotStatus>([&](auto reply) { watcher->get_status(std::move(reply)); }, kCall);
    return status ? status->lease : api::LeaseState{};
  };
  while (lease().owner != "anna") {
  }
  std::string output;
  EXPECT_EQ(seeker(daemon, {"--as", "cleo", "lease", "acquire", "--for", "1"}, &output), 3);
  EXPECT_NE(output.find("'anna'"), std::string::npos) << output;
  ChildProcess ben(program("seeker"), {"--as", "ben", "lease", "request", "--robot", daemon.address()},
                   daemon.folder() / "ben");
  while (lease().requested_by != "ben") {
  }
  EXPECT_EQ(seeker(daemon, {"--as", "anna", "lease", "grant"}), 0);
  EXPECT_EQ(lease().owner, "ben");
  EXPECT_EQ(anna.wait(seconds(20)), 3) << anna.output();
  // Ben asks the robot now and then, and does not know yet that he owns it.
  while (ben.output().find("'ben' holds the lease") == std::string::npos) {
    ASSERT_EQ(lease().owner, "ben");
  }
  ben.send(SIGINT);
  EXPECT_EQ(ben.wait(seconds(20)), 0) << ben.output();
  EXPECT_TRUE(lease().owner.empty());
}

TEST(Processes, TerminationIsOrderlyAndWrongConfigurationHasItsOwnCode) {
  Daemon daemon;
  daemon.process->send(SIGTERM);
  EXPECT_EQ(daemon.process->wait(seconds(20)), 0) << daemon.process->output();
  ChildProcess wrong(program("seekerd"), {"--config", source_file("config/robots/sim.yaml"), "--set", "sim.sped=1"},
                     daemon.folder() / "wrong");
  EXPECT_EQ(wrong.wait(seconds(20)), 78);
  EXPECT_NE(wrong.output().find("sim.sped"), std::string::npos) << wrong.output();
  ChildProcess loud(program("seekerd"), {"--log-level", "loud"}, daemon.folder() / "loud");
  EXPECT_EQ(loud.wait(seconds(20)), 2);
}

/// The laser of the robot whose logs these are.
const std::vector<std::string> kLaserOfTrace0 = {
    "--set", "replay.laser.angle_min_deg=-135", "--set", "replay.laser.angle_step_deg=0.351562",
    "--set", "replay.laser.range_max_m=5.6",    "--set", "replay.laser.base_T_laser=[0.135, 0, 0]"};

/// Plays the log to its end with this client attached and gives what the robot says of it then.
std::string play_to_the_end(rpc::RobotClient& client) {
  std::promise<std::string> ended;
  auto subscription = client.subscribe({{.topic = api::Topic::kEvent, .resume_after = 0}, {.topic = api::Topic::kScan}},
                                       [&](const api::UpdatePtr& update) {
                                         if (const auto* event = std::get_if<api::Event>(&update->payload);
                                             event != nullptr && event->kind == "source-ended") {
                                           ended.set_value(event->text);
                                         }
                                       });
  auto future = ended.get_future();
  return subscription && future.wait_for(seconds(120)) == std::future_status::ready ? future.get() : std::string();
}

using Wall = std::array<double, 4>;

/// As `seeker-lab slam` writes them: x1,y1,x2,y2 in metres, four decimals, remarks with '#'.
std::vector<Wall> walls_in(const std::filesystem::path& csv) {
  std::vector<Wall> walls;
  std::ifstream file(csv);
  for (std::string line; std::getline(file, line);) {
    if (Wall w; std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &w[0], &w[1], &w[2], &w[3]) == 4) {
      walls.push_back(w);
    }
  }
  return walls;
}

std::vector<Wall> walls_of(rpc::RobotClient& client) {
  const Result<api::SegmentUpdate> update =
      rpc::wait<api::SegmentUpdate>([&](auto reply) { client.get_segments(0, std::move(reply)); }, kCall);
  std::vector<Wall> walls;
  for (const MapSegment& segment : update ? update->changed : std::vector<MapSegment>()) {
    walls.push_back({segment.left().x(), segment.left().y(), segment.right().x(), segment.right().y()});
  }
  return walls;
}

TEST(Processes, ReplayOfARecordedLogGivesAClientTheMapThatTheLogGivesOffline) {
  SEEKER_REQUIRE_DATA(log, "lidar/p3dx/trace0.clf.gz");
  const std::filesystem::path folder = fresh_folder("replay");
  std::vector<std::string> online = {"--config",    source_file("config/robots/replay.yaml"),
                                     "--port",      "0",
                                     "--port-file", folder / "port",
                                     "--state",     folder / "state",
                                     "--set",       "replay.log=" + log.string(),
                                     "--set",       "replay.speed=0"};
  online.insert(online.end(), kLaserOfTrace0.begin(), kLaserOfTrace0.end());
  ChildProcess server(program("seekerd"), online, folder / "log");
  const std::optional<std::string> port = wait_for_file(folder / "port", kStart);
  ASSERT_TRUE(port) << server.output();
  rpc::ClientParams params;
  params.client_name = "viewer";
  auto client = rpc::RobotClient::connect({"127.0.0.1", static_cast<std::uint16_t>(std::stoi(*port))}, params);
  ASSERT_TRUE(client) << client.error().message;
  const std::string summary = play_to_the_end(**client);
  EXPECT_NE(summary.find("958"), std::string::npos) << "the summary tells how many scans were read: " << summary;
  const Result<api::TileUpdate> tiles =
      rpc::wait<api::TileUpdate>([&](auto reply) { (*client)->get_tiles(0, std::move(reply)); }, kCall);
  ASSERT_TRUE(tiles);
  EXPECT_GT(tiles->tiles.size(), 10U);

  std::vector<std::string> offline = {"slam",         log,       "--out",
                                      folder / "lab", "--robot", source_file("config/robots/replay.yaml")};
  offline.insert(offline.end(), kLaserOfTrace0.begin(), kLaserOfTrace0.end());
  ChildProcess lab(program("seeker-lab"), offline, folder / "lab.log");
  ASSERT_EQ(lab.wait(seconds(120)), 0) << lab.output();
  std::vector<Wall> expected = walls_in(folder / "lab" / "walls.csv");
  std::vector<Wall> seen = walls_of(**client);
  ASSERT_GT(expected.size(), 50U);
  ASSERT_EQ(seen.size(), expected.size());
  constexpr double kDecimals_m = 0.00011;  // the file's four
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_THAT(seen[k], ::testing::Pointwise(::testing::DoubleNear(kDecimals_m), expected[k])) << k;
  }
}

}  // namespace
}  // namespace seeker::testing
