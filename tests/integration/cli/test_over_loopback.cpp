#include <filesystem>
#include <sstream>
#include <thread>

#include <unistd.h>

#include <gtest/gtest.h>

#include "client/cli/program.hpp"
#include "server/net/server.hpp"
#include "tests/support/fake_robot.hpp"

namespace seeker::cli {
namespace {

struct Ran {
  int code = 0;
  std::string out;
  std::string err;
};

/// A server on a free port with a robot in memory behind it; the command lines connect over the network.
class CliOverLoopback : public ::testing::Test {
 protected:
  void SetUp() override {
    server_net::ServerParams params;
    params.port = 0;
    server_ = std::make_unique<server_net::Server>(host_, params);
    const auto port = server_->start();
    ASSERT_TRUE(port) << port.error().message;
    robot_ = "127.0.0.1:" + std::to_string(*port);
  }

  Ran run(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--robot", robot_});
    std::ostringstream out;
    std::ostringstream err;
    Process process;
    process.out = &out;
    process.err = &err;
    const ExitCode code = run_program(arguments, process, connect_robot);
    return {static_cast<int>(code), out.str(), err.str()};
  }

  testing::FakeRobotHost host_;
  std::unique_ptr<server_net::Server> server_;
  std::string robot_;
};

TEST_F(CliOverLoopback, StatusComponentsAndDetectionsArrive) {
  const Ran status = run({"status", "--json"});
  EXPECT_EQ(status.code, 0) << status.err;
  EXPECT_NE(status.out.find("\"robot_id\":\"fake\""), std::string::npos) << status.out;
  EXPECT_NE(run({"components"}).out.find("base"), std::string::npos);
  EXPECT_NE(run({"detections"}).out.find("exit-sign at (3.00, 4.00)"), std::string::npos);
}

TEST_F(CliOverLoopback, MissionIsFollowedToItsEnd) {
  std::thread robot([this] {
    for (;;) {
      auto mission = host_.values().mission;
      if (mission) {
        mission->state = api::MissionState::kEnded;
        mission->updated = mission->started + seconds(9);
        mission->end = api::MissionEnd{api::Outcome::kComplete, "arrived", "", {}};
        host_.edit([&](testing::FakeRobotValues& v) { v.mission = mission; });
        host_.publish(api::Topic::kMission, mission->updated, *mission);
        return;
      }
      std::this_thread::yield();
    }
  });
  const Ran ran = run({"goto", "1,1"});
  robot.join();
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("COMPLETE"), std::string::npos);
}

TEST_F(CliOverLoopback, RefusalsKeepTheirCodeOverTheWire) {
  host_.edit([](testing::FakeRobotValues& v) { v.lease = {"somebody-else", 3, ""}; });
  EXPECT_EQ(run({"drive", "0.1", "0"}).code, 3);
  EXPECT_EQ(run({"pause"}).code, 1);
  EXPECT_EQ(run({"camera", "grab", "--camera", "none", "--out", "/dev/null"}).code, 1);
}

TEST_F(CliOverLoopback, DriveHoldsTheLeaseAndGivesItBack) {
  const Ran ran = run({"drive", "0.1", "0", "--for", "0.3"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_GE(host_.values().drives.size(), 3U);
  EXPECT_TRUE(host_.values().lease.owner.empty());
}

TEST_F(CliOverLoopback, MapIsExported) {
  const auto prefix = std::filesystem::path(::testing::TempDir()) / ("seeker_cli_" + std::to_string(::getpid()));
  const Ran ran = run({"map", "export", prefix.string()});
  EXPECT_EQ(ran.code, 0) << ran.err;
  for (const char* extension : {".png", ".pgm", ".yaml"}) {
    EXPECT_TRUE(std::filesystem::remove(prefix.string() + extension)) << extension;
  }
}

TEST_F(CliOverLoopback, StoppedServerIsNoLink) {
  server_->stop();
  EXPECT_EQ(run({"status"}).code, 4);
}

}  // namespace
}  // namespace seeker::cli
