#include "server/lab/search/mission_scripts.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <thread>

#include "common/config/yaml.hpp"
#include "server/lab/experiments/child_process.hpp"

namespace seeker::lab {
namespace {

constexpr std::chrono::milliseconds kPollPeriod(50);
constexpr std::chrono::seconds kEndLimit(20);

/// A script says in its first comment which world it is for, as config/worlds/NAME.yaml; nothing: the robot file's.
std::optional<std::string> world_named_in(const std::filesystem::path& script) {
  const Result<std::string> text = config::read_text_file(script);
  std::smatch match;
  if (!text || !std::regex_search(*text, match, std::regex("config/worlds/([A-Za-z0-9_-]+\\.yaml)"))) {
    return std::nullopt;
  }
  return match[1].str();
}

/// The port that the server writes once it can be reached.
std::optional<int> wait_for_port(ChildProcess& server, const std::filesystem::path& file, std::chrono::seconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  while (std::chrono::steady_clock::now() < until && server.running()) {
    int port = 0;
    if (std::ifstream(file) >> port && port > 0) {
      return port;
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
  return std::nullopt;
}

Check play(const ScriptParams& params, const std::filesystem::path& script) {
  const std::string name = script.stem().string();
  const std::filesystem::path folder = std::filesystem::absolute(params.out) / "r12" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  Check check{.id = "R12", .passed = false, .figures = {{"script", name}}};

  std::vector<std::string> arguments = {"--config",    (params.config / "robots" / "sim.yaml").string(),
                                        "--port",      "0",
                                        "--state",     (folder / "state").string(),
                                        "--port-file", (folder / "port").string()};
  if (const std::optional<std::string> world = world_named_in(script)) {
    arguments.insert(arguments.end(),
                     {"--set", "sim.world=" + std::filesystem::absolute(params.config / "worlds" / *world).string()});
  }
  Result<ChildProcess> server = ChildProcess::start(params.programs / "seekerd", arguments, folder / "seekerd.log");
  if (!server) {
    check.figures.emplace_back("problem", "seekerd-not-started");
    return check;
  }
  const std::optional<int> port = wait_for_port(*server, folder / "port", params.start_limit);
  if (!port) {
    check.figures.emplace_back("problem", "seekerd-not-reachable");
    return check;
  }
  const auto started = std::chrono::steady_clock::now();
  Result<ChildProcess> client =
      ChildProcess::start(params.programs / "seeker",
                          {"--robot", "127.0.0.1:" + std::to_string(*port), "run", script.string(), "--targets",
                           (params.config / "targets").string()},
                          folder / "seeker.log");
  const std::optional<int> client_code = client ? client->wait(params.script_limit) : std::nullopt;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  const std::optional<int> server_code = server->terminate(kEndLimit);
  check.figures.emplace_back("exit_code", client_code ? std::to_string(*client_code) : "none");
  check.figures.emplace_back("server_exit_code", server_code ? std::to_string(*server_code) : "none");
  check.figures.emplace_back("wall_s", std::to_string(static_cast<int>(wall.count())));
  check.passed = client_code == 0 && server_code == 0;
  return check;
}

}  // namespace

Status check_mission_scripts(const ScriptParams& params, Report& report) {
  for (const char* program : {"seekerd", "seeker"}) {
    if (!std::filesystem::exists(params.programs / program)) {
      return fail(Errc::kNotFound, (params.programs / program).string() +
                                       ": not there; build it ('./run build') or name its folder with --programs");
    }
  }
  std::vector<std::filesystem::path> scripts;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(params.config / "missions", error)) {
    if (entry.path().extension() == ".yaml") {
      scripts.push_back(entry.path());
    }
  }
  if (scripts.empty()) {
    return fail(Errc::kNotFound,
                (params.config / "missions").string() + ": no mission scripts there; name the folder with --config");
  }
  std::sort(scripts.begin(), scripts.end());
  for (const std::filesystem::path& script : scripts) {
    report.add(play(params, script));
  }
  return {};
}

}  // namespace seeker::lab
