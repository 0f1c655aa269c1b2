#include "server/app/daemon/daemon.hpp"

#include <chrono>
#include <cstdlib>
#include <iostream>

#include "common/files/config_folder.hpp"
#include "common/files/files.hpp"
#include "common/files/temporary_file.hpp"
#include "common/log/log.hpp"
#include "server/app/composition/link_options.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/app/daemon/heap.hpp"
#include "server/app/daemon/service_notifier.hpp"
#include "server/app/fleet/fleet_part.hpp"
#include "server/app/metrics/metrics_service.hpp"
#include "server/app/robot/robot.hpp"
#include "server/app/runtime/termination_signals.hpp"
#include "server/app/state/audit_trail.hpp"
#include "server/net/server.hpp"

namespace seeker::app {
namespace {

constexpr int kExitConfig = 78;  // sysexits EX_CONFIG
constexpr const char* kPart = "seekerd";

int config_error(const Error& error) {
  log::error(kPart, error.message);
  return kExitConfig;
}

void warn_of_cut_off(const Journal& journal) {
  if (const auto& mission = journal.unfinished()) {
    log::warning(kPart, "mission '" + mission->id +
                            "' was cut off when the program ended; 'seeker resume' starts it again, the robot stays "
                            "disarmed until then");
  }
}

Status announce(const DaemonArguments& arguments, const RobotOptions& options, std::uint16_t port) {
  log::info(kPart, options.robot_id + " listens on " + options.server.address + ":" + std::to_string(port));
  return arguments.port_file.empty() ? Status() : files::write_file(arguments.port_file, std::to_string(port) + "\n");
}

/// Returns when a signal asks for the end, or at the end of a replay that ends the program.
void wait_for_end(const TerminationSignals& signals, const RobotOptions& options, const Robot& robot) {
  constexpr std::chrono::milliseconds kPoll{200};
  while (!signals.wait(kPoll)) {
    if (options.replay.exit_at_end && robot.ended()) {
      log::info(kPart, "the log has ended");
      return;
    }
  }
}

/// Without a file there is nothing to record, which is no error.
Status record(const DaemonArguments& arguments, const RobotOptions& options, Robot& robot) {
  const std::string& file = arguments.record.empty() ? options.record : arguments.record;
  if (file.empty()) {
    return {};
  }
  // In lockstep robot time has nothing to do with that of the world.
  using Seconds = std::chrono::duration<double>;
  const double wall_s = Seconds(std::chrono::system_clock::now().time_since_epoch()).count();
  const double epoch_s = robot.loop().world().realtime() ? wall_s - to_seconds(robot.loop().now()) : 0.0;
  Result<std::unique_ptr<DriveRecorder>> recorder = DriveRecorder::create(file, options.robot_id, epoch_s);
  if (!recorder) {
    return tl::unexpected<Error>(recorder.error());
  }
  log::info(kPart, "recording into " + (*recorder)->path().string());
  robot.record(std::move(*recorder));
  return {};
}

/// Without settings there is no page, which is no error. The page serves before there is a robot.
Result<std::unique_ptr<MetricsService>> start_metrics(const RobotOptions& options) {
  if (!options.metrics) {
    return std::unique_ptr<MetricsService>();
  }
  Result<std::unique_ptr<MetricsService>> metrics =
      MetricsService::start(*options.metrics, options.robot_id, SEEKER_VERSION);
  if (metrics) {
    log::info(kPart,
              "metrics at http://" + options.metrics->address + ":" + std::to_string((*metrics)->port()) + "/metrics");
  }
  return metrics;
}

/// Runs the robot and its server to their orderly end.
Status run(const DaemonArguments& arguments, const RobotOptions& options, const TerminationSignals& signals,
           Robot& robot, const ServiceNotifier& service, MetricsService* metrics) {
  server_net::ServerParams params = options.server;
  params.port = arguments.port.value_or(params.port);
  params.security = link_security(options);
  params.robot_now = [&robot] { return robot.now(); };
  if (robot.loop().world().realtime()) {
    // A simulation that goes as fast as it can takes its time for one tick where it must, and nothing moves meanwhile.
    params.loop_pass = [&robot] { return robot.passes(); };
  }
  params.on_link_faults = [&robot](const std::vector<api::Fault>& faults) { robot.set_link_faults(faults); };
  server_net::Server server(robot, params);
  robot.start(options.driver == DriverType::kReplay && options.replay.wait_for_client);
  const Result<std::uint16_t> port = server.start();
  if (!port) {
    return tl::unexpected<Error>(port.error());
  }
  if (Status announced = announce(arguments, options, *port); !announced) {
    return announced;
  }
  if (metrics != nullptr) {
    metrics->metrics().set_server([&server] { return server.stats(); });
  }
  service.ready();
  wait_for_end(signals, options, robot);
  if (metrics != nullptr) {
    metrics->metrics().set_server({});
  }
  log::info(kPart, "stopping: motion first, then the sessions");
  service.stopping();
  robot.stop();
  server.stop();
  return {};
}

/// Has the robot keep in its folder who commands what, and say what there is to say of its machine.
Status make_answerable(const RobotOptions& options, const std::filesystem::path& folder, Robot& robot) {
  Result<std::unique_ptr<AuditTrail>> audit = AuditTrail::open(folder);
  if (!audit) {
    return tl::unexpected<Error>(audit.error());
  }
  robot.keep_audit(std::move(*audit));
  robot.diagnose({.version = SEEKER_VERSION,
                  .folder = folder,
                  .certificate = link_security(options).files.certificate,
                  .journal = {},
                  .audit_lost = {}});
  return {};
}

/// What was being written when the program was killed: the files it was to replace are as they were.
void tidy(const std::filesystem::path& state) {
  if (const std::size_t count = files::remove_left_over(state); count > 0) {
    log::info(kPart, "removed " + std::to_string(count) + " half-written files that a kill left in " + state.string());
  }
}

int serve(const DaemonArguments& arguments, const RobotOptions& options, const std::filesystem::path& state,
          const TerminationSignals& signals, Assembly assembly) {
  tidy(state);
  Result<std::unique_ptr<Journal>> journal = Journal::open(state / options.robot_id);
  if (!journal) {
    log::error(kPart, journal.error().message);
    return EXIT_FAILURE;
  }
  warn_of_cut_off(**journal);
  // Before the robot, whose loop speaks to both until the end.
  ServiceNotifier service;
  const Result<std::unique_ptr<MetricsService>> metrics = start_metrics(options);
  if (!metrics) {
    return config_error(metrics.error());
  }
  Robot robot(
      {.robot_id = options.robot_id, .software_version = SEEKER_VERSION, .robot_radius_m = options.robot_radius_m},
      options.loop, std::move(assembly.parts), std::move(*journal), state / "maps", std::move(assembly.landmarks),
      state / "incoming");
  if (const Status answerable = make_answerable(options, state / options.robot_id, robot); !answerable) {
    log::error(kPart, answerable.error().message);
    return EXIT_FAILURE;
  }
  robot.loop().hooks().on_pass = [&robot, &service](WallTime now) {
    service.passed(now, [&robot] { return service_state(robot.loop().status()); });
  };
  if (*metrics) {
    (*metrics)->follow(robot.loop().hooks(), robot);
  }
  if (const Status recording = record(arguments, options, robot); !recording) {
    return config_error(recording.error());
  }
  FleetSettings settings = options.fleet;
  settings.security = link_security(options);
  const Result<FleetPart> fleet =
      start_fleet(settings, options.robot_id, SEEKER_VERSION, state / options.robot_id / "fleet", robot.fleet_host());
  if (!fleet) {
    return config_error(fleet.error());
  }
  if (const Status ran = run(arguments, options, signals, robot, service, metrics->get()); !ran) {
    log::error(kPart, ran.error().message);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace

std::filesystem::path default_state_folder() {
  if (const char* folder = std::getenv("STATE_DIRECTORY"); folder != nullptr && *folder != '\0') {
    return folder;
  }
  if (const char* folder = std::getenv("XDG_STATE_HOME"); folder != nullptr && *folder != '\0') {
    return std::filesystem::path(folder) / "seeker";
  }
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : ".") / ".local/state/seeker";
}

int run_daemon(const DaemonArguments& arguments) {
  keep_heap_compact();
  log::set_level(log::parse_level(arguments.log_level).value_or(log::Level::kInfo));
  if (const std::optional<log::Format> format = log::parse_format(arguments.log_format)) {
    log::set_format(*format);
  }
  const Result<RobotOptions> options =
      load_robot_options(files::named_file(arguments.config, files::config_folder() / "robots"), arguments.overrides);
  if (!options) {
    return config_error(options.error());
  }
  if (arguments.print_config) {
    std::cout << config::print(*options);
    return EXIT_SUCCESS;
  }
  if (const Status links = check_links(*options); !links) {
    return config_error(links.error());
  }
  const std::filesystem::path state = arguments.state.empty() ? default_state_folder() : arguments.state;
  // Before any thread: making the robot starts some, and one that does not block a signal dies of it with all others.
  const TerminationSignals signals;
  Result<Assembly> assembly = assemble(
      *options, {.folder = state / "landmarks", .robot_id = options->robot_id, .software_version = SEEKER_VERSION});
  if (!assembly) {
    // What is not there yet may be there at the next start.
    const Errc code = assembly.error().code;
    const int wrong = config_error(assembly.error());
    return code == Errc::kLinkLost || code == Errc::kTimeout ? EXIT_FAILURE : wrong;
  }
  return serve(arguments, *options, state, signals, std::move(*assembly));
}

}  // namespace seeker::app
