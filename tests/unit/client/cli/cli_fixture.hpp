/// \file
/// Runs command lines against a robot in memory.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "client/cli/program.hpp"
#include "tests/support/data.hpp"
#include "tests/support/fake_robot.hpp"
#include "tests/support/json_text.hpp"

namespace seeker::cli {

using testing::is_json;

struct Ran {
  int code = 0;
  std::string out;
  std::string err;
};

class CliFixture {
 public:
  std::unique_ptr<testing::FakeRobotHost> host = std::make_unique<testing::FakeRobotHost>();
  std::atomic<bool> interrupted{false};
  std::optional<Error> connect_error;

  /// `during` runs on another thread while the command runs.
  Ran run(const std::vector<std::string>& arguments, const std::function<void()>& during = {}) {
    std::ostringstream out;
    std::ostringstream err;
    Process process;
    process.out = &out;
    process.err = &err;
    process.interrupted = [this] { return interrupted.load(); };
    const Connector connect = [this](const ConnectRequest& /*request*/) -> Result<Connection> {
      if (connect_error) {
        return tl::unexpected<Error>(*connect_error);
      }
      Connection connection;
      connection.robot = host->open({"seeker-test", api::Role::kOperator});
      connection.client_name = "seeker-test";
      return connection;
    };
    std::thread helper;
    if (during) {
      helper = std::thread(during);
    }
    const ExitCode code = run_program(arguments, process, connect);
    if (helper.joinable()) {
      helper.join();
    }
    return {static_cast<int>(code), out.str(), err.str()};
  }

  /// Waits until a mission was started, then ends it; to be run beside a command.
  void end_mission(api::Outcome outcome, double robot_time_s = 42.0,
                   const std::vector<UnreachablePlace>& unreachable = {}) {
    for (;;) {
      const auto mission = host->values().mission;
      if (mission && !mission->end) {
        api::MissionStatus ended = *mission;
        ended.state = api::MissionState::kEnded;
        ended.updated = ended.started + seconds(robot_time_s);
        ended.path_length_m = 12.5;
        ended.coverage = api::CoverageSummary{20.0, 18.0, 0.5, 0.8, 1};
        ended.end = api::MissionEnd{outcome, "the cause", "the remedy", unreachable};
        host->edit([&](testing::FakeRobotValues& v) { v.mission = ended; });
        host->publish(api::Topic::kMission, ended.updated, ended);
        return;
      }
      std::this_thread::yield();
    }
  }
};

}  // namespace seeker::cli
