#include "server/lab/slam/slam_command.hpp"

#include <cstdio>

#include "server/lab/slam/robot_of_log.hpp"
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

Status run_slam_command(const SlamOptions& o, std::ostream& out) {
  const Result<RobotOfLog> robot = robot_of_log(o.robot, o.config, o.log, o.overrides);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  SlamSource source;
  source.log = o.log;
  source.robot_file = robot->file;
  source.estimator = o.estimator.empty() ? name_of(robot->options.estimator) : o.estimator;
  source.geometry = robot->options.replay.params;
  source.occupancy = robot->options.occupancy;
  const Result<std::unique_ptr<slam::PoseTracker>> tracker = make_tracker(source.estimator, robot->options);
  if (!tracker) {
    return tl::unexpected<Error>(tracker.error());
  }
  const Result<SlamRun> run = run_slam(o.log, source.geometry, **tracker, progress_line(o.show_progress), {},
                                       robot->options.loop.odometry_calibration);
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
