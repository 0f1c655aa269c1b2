/// \file
/// The program that hosts one world for several robots.
#pragma once

#include <map>

#include "tests/integration/processes/daemon.hpp"
#include "tests/integration/processes/truth.hpp"

namespace seeker::testing {

/// seeker-emulator; by default with two robots in the corridor world.
class Emulator {
 public:
  /// `speed`: at most so many seconds of the world in one of life; 0: as fast as the robots are.
  explicit Emulator(const std::filesystem::path& folder = fresh_folder("emulator"),
                    const std::filesystem::path& world = source_file("config/worlds/corridor.yaml"),
                    const std::filesystem::path& config = source_file("config/robots/sim.yaml"), int robots = 2,
                    double speed = 0.0)
      : truth(folder / "truth.csv") {
    const std::filesystem::path port_file = folder / "port";
    process.emplace(program("seeker-emulator"),
                    std::vector<std::string>{"--world", world, "--config", config, "--robots", std::to_string(robots),
                                             "--lockstep", "--set", "sim.speed=" + std::to_string(speed), "--port", "0",
                                             "--port-file", port_file, "--truth", truth},
                    folder / "log");
    const std::optional<std::string> text = wait_for_file(port_file, kStart);
    EXPECT_TRUE(text) << process->output();
    port = text ? text->substr(0, text->find('\n')) : "";
  }

  /// What robot `number` is started with.
  [[nodiscard]] std::vector<std::string> robot(int number) const {
    return {"--set", "driver=emulator",
            "--set", "emulator.address=127.0.0.1:" + port,
            "--set", "emulator.robot=" + std::to_string(number),
            "--set", "robot_id=r" + std::to_string(number)};
  }

  /// Where each robot has been, x and y in the frame of the world.
  [[nodiscard]] std::map<int, std::vector<Point2>> paths() const {
    std::map<int, std::vector<Point2>> paths;
    for (const TruthRow& row : read_truth(truth)) {
      paths[row.robot].push_back(row.p_world);
    }
    return paths;
  }

  std::filesystem::path truth;
  std::optional<ChildProcess> process;
  std::string port;
};

}  // namespace seeker::testing
