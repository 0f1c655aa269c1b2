// A main robot and one that joins it, over real sockets, and over the death of either.

#include <functional>
#include <thread>

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> main_robot(const std::string& port) {
  return {"--set", "robot_id=main", "--set", "fleet.lead=true", "--set", "fleet.port=" + port};
}

std::vector<std::string> joins(const std::string& port, const std::string& robot_id) {
  return {"--set", "robot_id=" + robot_id, "--set", "fleet.join=127.0.0.1:" + port, "--set", "fleet.period_s=0.2"};
}

std::string fleet_port(const Daemon& daemon) {
  const auto text = wait_for_file(daemon.folder() / "state" / "main" / "fleet" / "port", kStart);
  EXPECT_TRUE(text);
  return text ? text->substr(0, text->find('\n')) : "";
}

/// Asks the main robot until its answer is as wanted.
std::string until(const std::string& port, const std::function<bool(const std::string&)>& wanted) {
  const auto end = std::chrono::steady_clock::now() + seconds(120);
  std::string output;
  while (std::chrono::steady_clock::now() < end) {
    ChildProcess client(program("seeker"), {"fleet", "status", "--json", "--main", "127.0.0.1:" + port},
                        fresh_folder("fleet_client") / "out");
    EXPECT_TRUE(client.wait(seconds(60)));
    output = client.output();
    if (wanted(output)) {
      return output;
    }
  }
  ADD_FAILURE() << output;
  return output;
}

/// Draws the joint map as soon as a robot of the fleet has reported.
bool drawn(const std::string& port, const fs::path& picture) {
  const auto end = std::chrono::steady_clock::now() + seconds(120);
  while (std::chrono::steady_clock::now() < end) {
    ChildProcess client(program("seeker"),
                        {"fleet", "map", picture.string(), "--format", "png,svg", "--main", "127.0.0.1:" + port},
                        fresh_folder("fleet_draw") / "out");
    if (client.wait(seconds(60)) == 0) {
      return true;
    }
  }
  return false;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FleetProcesses, ARobotJoinsAndNothingIsLostWhenTheMainOneDies) {
  const fs::path folder = fresh_folder("fleet_main");
  std::string port = "0";
  std::optional<Daemon> robot;
  {
    Daemon main(main_robot(port), folder);
    port = fleet_port(main);
    robot.emplace(joins(port, "r1"));
    std::string output;
    EXPECT_EQ(seeker(main, {"goto", "1,0"}, &output), 0) << output;
    EXPECT_EQ(seeker(*robot, {"goto", "1,0"}, &output), 0) << output;
    static_cast<void>(until(port, [](const std::string& answer) {
      return has(answer, "\"robot_id\":\"r1\"") && has(answer, "\"pieces_missing\":0") &&
             !has(answer, "not been looked");
    }));
    main.kill();
  }
  robot->kill();
  const Daemon again(main_robot(port), folder);
  const std::string kept = until(port, [](const std::string& answer) { return has(answer, "\"robot_id\":\"r1\""); });
  EXPECT_TRUE(has(kept, "\"linked\":false")) << kept;
  const Daemon back(joins(port, "r1"));
  static_cast<void>(until(port, [](const std::string& answer) { return !has(answer, "\"linked\":false"); }));
  const fs::path picture = fresh_folder("fleet_picture") / "joint";
  EXPECT_TRUE(drawn(port, picture)) << "the main robot reports within some seconds of its start";
  EXPECT_TRUE(fs::exists(picture.string() + ".png") && fs::exists(picture.string() + ".svg"));
  ChildProcess split(program("seeker"), {"fleet", "split", "r1", "--main", "127.0.0.1:" + port},
                     fresh_folder("fleet_split") / "out");
  EXPECT_EQ(split.wait(seconds(60)), 0) << split.output();
  EXPECT_TRUE(has(split.output(), "SPLIT")) << split.output();
}

TEST(FleetProcesses, ANamesakeOfTheMainRobotIsToldSo) {
  const Daemon main(main_robot("0"), fresh_folder("fleet_namesake"));
  const Daemon namesake(joins(fleet_port(main), "main"));
  std::string log;
  while (!has(log, "give each its own robot_id")) {
    log = namesake.process->output();
    std::this_thread::yield();
  }
  static_cast<void>(until(fleet_port(main), [](const std::string& answer) { return has(answer, "\"members\":[{"); }));
}

}  // namespace
}  // namespace seeker::testing
