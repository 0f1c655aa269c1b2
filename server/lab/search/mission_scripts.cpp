#include "server/lab/search/mission_scripts.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <thread>

#include "common/config/yaml.hpp"
#include "server/lab/experiments/child_process.hpp"

namespace seeker::lab {
namespace {

constexpr std::chrono::milliseconds kPollPeriod(50);
constexpr std::chrono::seconds kEndLimit(20);

/// What `seeker run --check --json` says of a script. Only what it is for matters here.
struct ScriptSetup {
  std::string script;
  bool ok = false;
  std::optional<std::string> robot;  ///< a robot file; nothing: any robot will do
  std::optional<std::string> world;  ///< a world file; nothing: that of the robot file
  int steps_planned = 0;
  std::vector<std::string> steps;
};
void describe(config::Fields& f, ScriptSetup& setup) {
  f.field("script", setup.script);
  f.field("ok", setup.ok);
  f.optional_field("robot", setup.robot);
  f.optional_field("world", setup.world);
  f.field("steps_planned", setup.steps_planned);
  f.field("steps", setup.steps);
}

/// The robot and the world that a script names, as the client reads it, which is the one strict reader of scripts.
Result<ScriptSetup> setup_of(const ScriptParams& params, const std::filesystem::path& script,
                             const std::filesystem::path& folder) {
  const std::filesystem::path answer = folder / "script.json";
  Result<ChildProcess> client = ChildProcess::start(
      params.programs / "seeker",
      {"run", script.string(), "--check", "--json", "--targets", (params.config / "targets").string()}, answer);
  if (!client) {
    return tl::unexpected<Error>(client.error());
  }
  if (client->wait(params.start_limit) != 0) {
    return fail(Errc::kParse, "the client refuses " + script.string() + "; its reason is in " + answer.string());
  }
  ScriptSetup setup;
  if (const Status ok = config::load_file(answer, setup); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return setup;
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

  const Result<ScriptSetup> setup = setup_of(params, script, folder);
  if (!setup) {
    check.figures.emplace_back("problem", "script-refused");
    return check;
  }
  std::vector<std::string> arguments = {
      "--config",    setup->robot.value_or((params.config / "robots" / "sim.yaml").string()),
      "--port",      "0",
      "--state",     (folder / "state").string(),
      "--port-file", (folder / "port").string()};
  if (setup->world) {
    arguments.insert(arguments.end(), {"--set", "sim.world=" + *setup->world});
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
