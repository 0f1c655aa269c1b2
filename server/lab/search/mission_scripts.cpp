#include "server/lab/search/mission_scripts.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "common/api/mission.hpp"
#include "common/config/yaml.hpp"
#include "server/lab/experiments/child_process.hpp"

namespace seeker::lab {
namespace {

constexpr std::chrono::milliseconds kPollPeriod(50);
constexpr std::chrono::seconds kEndLimit(20);
/// Played in the smallest form: what each takes is seconds.
constexpr std::array kSmallestScripts{"goto-tour", "search-2007"};
constexpr const char* kFleetStep = "fleet";
/// Seconds of a shared world in one of the wall clock. Faster, and the robots would wait for the fleet's messages.
constexpr int kFleetSpeed = 10;

/// A step as `seeker run --json` reports it. Only what it is for matters here.
struct PlayedStep {
  int step = 0;
  std::string kind;
  bool ok = false;
  std::string outcome;
  std::string problem;
  double robot_time_s = 0.0;
  double wall_time_s = 0.0;
};
void describe(config::Fields& f, PlayedStep& step) {
  f.field("step", step.step);
  f.field("do", step.kind);
  f.field("ok", step.ok);
  f.field("outcome", step.outcome);
  f.field("problem", step.problem);
  f.field("robot_time_s", step.robot_time_s);
  f.field("wall_time_s", step.wall_time_s);
}

/// What `seeker run --json` says of a script, with --check or after it was played.
struct ScriptReport {
  std::string script;
  bool ok = false;
  std::optional<std::string> robot;  ///< a robot file; nothing: any robot will do
  std::optional<std::string> world;  ///< a world file; nothing: that of the robot file
  int robots = 1;
  int steps_planned = 0;
  std::vector<PlayedStep> steps;
};
void describe(config::Fields& f, ScriptReport& report) {
  f.field("script", report.script);
  f.field("ok", report.ok);
  f.optional_field("robot", report.robot);
  f.optional_field("world", report.world);
  f.field("robots", report.robots);
  f.field("steps_planned", report.steps_planned);
  f.list("steps", report.steps);
}

/// The robot and the world that a script names, as the client reads it, which is the one strict reader of scripts.
Result<ScriptReport> setup_of(const ScriptParams& params, const std::filesystem::path& script,
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
  ScriptReport setup;
  if (const Status ok = config::load_file(answer, setup); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return setup;
}

/// The port that a server writes once it can be reached.
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

/// The programs of one script, from its servers to its clients.
class Playing {
 public:
  Playing(const ScriptParams& params, std::filesystem::path script, ScriptReport setup, std::filesystem::path folder)
      : params_(params), script_(std::move(script)), setup_(std::move(setup)), folder_(std::move(folder)) {}

  /// Starts the world of several robots, then every robot's server. The problem, empty where there is none.
  [[nodiscard]] std::string start_servers() {
    if (setup_.robots > 1) {
      if (std::string problem = start_world(); !problem.empty()) {
        return problem;
      }
    }
    for (int k = 0; k < setup_.robots; ++k) {
      if (std::string problem = start_server(k); !problem.empty()) {
        return problem;
      }
    }
    return "";
  }

  /// Plays the script to all robots at once; the first exit code that is not 0, or 0. Nothing: a client did not end.
  [[nodiscard]] std::optional<int> play() {
    std::vector<ChildProcess> clients;
    for (int k = 0; k < setup_.robots; ++k) {
      std::vector<std::string> arguments = {
          "--robot",   address(ports_[static_cast<std::size_t>(k)]), "--json", "--quiet", "run", script_.string(),
          "--targets", (params_.config / "targets").string()};
      if (fleet_port_) {
        arguments.insert(arguments.end(), {"--main", address(*fleet_port_)});
      }
      Result<ChildProcess> client = ChildProcess::start(params_.programs / "seeker", arguments, report_file(k));
      if (!client) {
        return std::nullopt;
      }
      clients.push_back(std::move(*client));
    }
    std::optional<int> code = 0;
    for (ChildProcess& client : clients) {
      const std::optional<int> ended = client.wait(params_.script_limit);
      code = code == 0 ? ended : code;
    }
    return code;
  }

  /// Ends the servers; the first exit code that is not 0, or 0. Nothing: one did not end.
  [[nodiscard]] std::optional<int> end_servers() {
    std::optional<int> code = 0;
    for (ChildProcess& server : servers_) {
      const std::optional<int> ended = server.terminate(kEndLimit);
      code = code == 0 ? ended : code;
    }
    return code;
  }

  /// The kinds of the steps that the first robot has played as expected.
  [[nodiscard]] std::set<std::string> played() const {
    ScriptReport report;
    std::set<std::string> kinds;
    if (config::load_file(report_file(0), report)) {
      for (const PlayedStep& step : report.steps) {
        if (step.ok) {
          kinds.insert(step.kind);
        }
      }
    }
    return kinds;
  }

 private:
  static std::string address(int port) { return "127.0.0.1:" + std::to_string(port); }
  static std::string robot_id(int k) { return "r" + std::to_string(k); }
  [[nodiscard]] std::filesystem::path report_file(int k) const { return folder_ / ("seeker-" + robot_id(k) + ".json"); }
  [[nodiscard]] std::string robot_file() const {
    return setup_.robot.value_or((params_.config / "robots" / "sim.yaml").string());
  }

  std::string start_world() {
    std::vector<std::string> arguments = {"--config",
                                          robot_file(),
                                          "--robots",
                                          std::to_string(setup_.robots),
                                          "--lockstep",
                                          "--set",
                                          "sim.speed=" + std::to_string(kFleetSpeed),
                                          "--port",
                                          "0",
                                          "--port-file",
                                          (folder_ / "world-port").string()};
    if (setup_.world) {
      arguments.insert(arguments.end(), {"--world", *setup_.world});
    }
    Result<ChildProcess> world =
        ChildProcess::start(params_.programs / "seeker-emulator", arguments, folder_ / "seeker-emulator.log");
    if (!world) {
      return "seeker-emulator-not-started";
    }
    const std::optional<int> port = wait_for_port(*world, folder_ / "world-port", params_.start_limit);
    world_.emplace(std::move(*world));
    world_address_ = port ? address(*port) : "";
    return port ? "" : "seeker-emulator-not-reachable";
  }

  std::string start_server(int k) {
    const std::filesystem::path state = folder_ / (robot_id(k) + "-state");
    const std::filesystem::path port_file = folder_ / (robot_id(k) + "-port");
    std::vector<std::string> arguments = {"--config", robot_file(),   "--port",      "0",
                                          "--state",  state.string(), "--port-file", port_file.string()};
    for (const std::string& value : setup_.robots > 1 ? fleet_settings(k) : own_world()) {
      arguments.insert(arguments.end(), {"--set", value});
    }
    Result<ChildProcess> server =
        ChildProcess::start(params_.programs / "seekerd", arguments, folder_ / ("seekerd-" + robot_id(k) + ".log"));
    if (!server) {
      return "seekerd-not-started";
    }
    const std::optional<int> port = wait_for_port(*server, port_file, params_.start_limit);
    if (port && setup_.robots > 1 && k == 0) {
      fleet_port_ = wait_for_port(*server, state / robot_id(0) / "fleet" / "port", params_.start_limit);
    }
    servers_.push_back(std::move(*server));
    ports_.push_back(port.value_or(0));
    return !port ? "seekerd-not-reachable" : setup_.robots > 1 && !fleet_port_ ? "fleet-not-reachable" : "";
  }

  [[nodiscard]] std::vector<std::string> own_world() const {
    return setup_.world ? std::vector<std::string>{"sim.world=" + *setup_.world} : std::vector<std::string>{};
  }

  /// A place in the shared world, and periods of the fleet that suit its speed.
  [[nodiscard]] std::vector<std::string> fleet_settings(int k) const {
    std::vector<std::string> settings = {"robot_id=" + robot_id(k),
                                         "driver=emulator",
                                         "emulator.address=" + world_address_,
                                         "emulator.robot=" + std::to_string(k),
                                         "fleet.period_s=0.5",
                                         "fleet.share_period_s=0.2",
                                         "fleet.silence_s=1"};
    if (k == 0) {
      settings.insert(settings.end(), {"fleet.lead=true", "fleet.port=0"});
    } else {
      settings.push_back("fleet.join=" + address(fleet_port_.value_or(0)));
    }
    return settings;
  }

  const ScriptParams& params_;
  std::filesystem::path script_;
  ScriptReport setup_;
  std::filesystem::path folder_;
  std::optional<ChildProcess> world_;  ///< outlives the servers, which are robots of it
  std::string world_address_;
  std::vector<ChildProcess> servers_;
  std::vector<int> ports_;         ///< of the servers
  std::optional<int> fleet_port_;  ///< of the robot that leads
};

/// Adds the kinds of the steps that were played to `played`.
Check play(const ScriptParams& params, const std::filesystem::path& script, std::set<std::string>& played) {
  const std::string name = script.stem().string();
  const std::filesystem::path folder = std::filesystem::absolute(params.out) / "r12" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  Check check{.id = "R12", .passed = false, .figures = {{"script", name}}};

  Result<ScriptReport> setup = setup_of(params, script, folder);
  if (!setup) {
    check.figures.emplace_back("problem", "script-refused");
    return check;
  }
  Playing playing(params, script, std::move(*setup), folder);
  if (const std::string problem = playing.start_servers(); !problem.empty()) {
    check.figures.emplace_back("problem", problem);
    return check;
  }
  const auto started = std::chrono::steady_clock::now();
  const std::optional<int> client_code = playing.play();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  const std::optional<int> server_code = playing.end_servers();
  played.merge(playing.played());
  check.figures.emplace_back("exit_code", client_code ? std::to_string(*client_code) : "none");
  check.figures.emplace_back("server_exit_code", server_code ? std::to_string(*server_code) : "none");
  check.figures.emplace_back("wall_s", std::to_string(static_cast<int>(wall.count())));
  check.passed = client_code == 0 && server_code == 0;
  return check;
}

/// Every kind of mission there is.
template <std::size_t... kIndex>
std::vector<std::string> mission_kinds(std::index_sequence<kIndex...> /*all*/) {
  return {std::string(api::task_name(api::MissionTask(std::variant_alternative_t<kIndex, api::MissionTask>{})))...};
}

Check check_kinds(const std::set<std::string>& played) {
  std::vector<std::string> kinds = mission_kinds(std::make_index_sequence<std::variant_size_v<api::MissionTask>>());
  kinds.emplace_back(kFleetStep);
  std::string all;
  std::string missing;
  for (const std::string& kind : kinds) {
    std::string& list = played.contains(kind) ? all : missing;
    list += (list.empty() ? "" : ",") + kind;
  }
  return {.id = "R12",
          .passed = missing.empty(),
          .figures = {{"missions", all.empty() ? "none" : all}, {"missing", missing.empty() ? "none" : missing}}};
}

Result<std::vector<std::filesystem::path>> scripts_of(const ScriptParams& params) {
  std::vector<std::filesystem::path> scripts;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(params.config / "missions", error)) {
    const bool wanted =
        !params.smallest || std::ranges::find(kSmallestScripts, entry.path().stem().string()) != kSmallestScripts.end();
    if (entry.path().extension() == ".yaml" && wanted) {
      scripts.push_back(entry.path());
    }
  }
  if (scripts.empty()) {
    return fail(Errc::kNotFound,
                (params.config / "missions").string() + ": no mission scripts there; name the folder with --config");
  }
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

}  // namespace

Status check_mission_scripts(const ScriptParams& params, Report& report) {
  for (const char* program : {"seekerd", "seeker", "seeker-emulator"}) {
    if (!std::filesystem::exists(params.programs / program)) {
      return fail(Errc::kNotFound, (params.programs / program).string() +
                                       ": not there; build it ('./run build') or name its folder with --programs");
    }
  }
  const Result<std::vector<std::filesystem::path>> scripts = scripts_of(params);
  if (!scripts) {
    return tl::unexpected<Error>(scripts.error());
  }
  std::set<std::string> played;
  for (const std::filesystem::path& script : *scripts) {
    report.add(play(params, script, played));
  }
  if (!params.smallest) {
    report.add(check_kinds(played));
  }
  return {};
}

}  // namespace seeker::lab
