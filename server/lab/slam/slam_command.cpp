#include "server/lab/slam/slam_command.hpp"

#include <cstdio>

#include "common/files/config_folder.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/slam/log_geometry.hpp"
#include "server/lab/slam/slam_estimators.hpp"
#include "server/lab/slam/slam_report.hpp"
#include "server/lab/slam/slam_run.hpp"

namespace seeker::lab {
namespace {

SlamProgress progress_line(bool shown) {
  if (!shown) {
    return {};
  }
  return [](std::uint64_t scans, double time_s) {
    std::fprintf(stderr, "\r%llu scans, %.0f s of the log", static_cast<unsigned long long>(scans), time_s);
  };
}

}  // namespace

Result<std::filesystem::path> find_robot_file(const std::filesystem::path& robot, const std::filesystem::path& config,
                                              const std::filesystem::path& log) {
  if (robot.empty()) {
    const Result<std::string> name = robot_file_for(log);
    if (!name) {
      return tl::unexpected<Error>(name.error());
    }
    return config / "robots" / *name;
  }
  return files::named_file(robot.string(), config / "robots");
}

Status run_slam_command(const SlamOptions& o, std::ostream& out) {
  const Result<std::filesystem::path> robot_file = find_robot_file(o.robot, o.config, o.log);
  if (!robot_file) {
    return tl::unexpected<Error>(robot_file.error());
  }
  const Result<app::RobotOptions> options = app::load_robot_options(*robot_file, o.overrides);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  SlamSource source;
  source.log = o.log;
  source.robot_file = *robot_file;
  source.estimator = o.estimator.empty() ? name_of(options->estimator) : o.estimator;
  source.geometry = options->replay.params;
  source.occupancy = options->occupancy;
  const Result<std::unique_ptr<slam::PoseTracker>> tracker = make_tracker(source.estimator, *options);
  if (!tracker) {
    return tl::unexpected<Error>(tracker.error());
  }
  const Result<SlamRun> run = run_slam(o.log, source.geometry, **tracker, progress_line(o.show_progress), {},
                                       options->loop.odometry_calibration);
  if (o.show_progress) {
    std::fprintf(stderr, "\n");
  }
  if (!run) {
    return tl::unexpected<Error>(run.error());
  }
  out << (o.json ? slam_json(source, *run) : slam_text(source, *run));
  if (const Status saved = o.out.empty() ? Status{} : save_slam(o.out, source, *run); !saved) {
    return saved;
  }
  if (!run->log.damage.empty()) {
    return fail(Errc::kCorrupt, "the log ends early (" + run->log.damage + "): this is what its first " +
                                    std::to_string(run->log.scans) + " scans give");
  }
  return {};
}

}  // namespace seeker::lab
