#include "server/lab/map_merging/merge_command.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "common/core/angle.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/fleet/joint_map.hpp"
#include "server/lab/slam/robot_of_log.hpp"
#include "server/lab/slam/slam_estimators.hpp"
#include "server/store/map_file.hpp"

namespace seeker::lab {
namespace {

constexpr std::size_t kMaxLogs = 16;

using Clock = std::chrono::steady_clock;

/// There are no more than kMaxLogs.
std::uint8_t slot_of(std::size_t log) { return static_cast<std::uint8_t>(log); }

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

SlamProgress progress_line(const MergeOptions& o, const std::string& name) {
  if (!o.show_progress) {
    return {};
  }
  return [name](std::uint64_t scans, double time_s) {
    std::fprintf(stderr, "\r%s: %llu scans, %.0f s of the log", name.c_str(), static_cast<unsigned long long>(scans),
                 time_s);
  };
}

Result<SlamRun> run_log(const MergeOptions& o, const std::filesystem::path& log, const LogSpan& span) {
  const Result<RobotOfLog> robot = robot_of_log(o.robot, o.config, log, o.overrides);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  const auto tracker = make_tracker(name_of(robot->options.estimator), robot->options);
  if (!tracker) {
    return tl::unexpected<Error>(tracker.error());
  }
  Result<SlamRun> run =
      run_slam(log, robot->options.replay.params, **tracker, progress_line(o, log.filename().string()), span,
               robot->options.loop.odometry_calibration);
  if (run && run->map.nodes.empty()) {
    return fail(Errc::kInvalidArgument, "the estimator of " + robot->file.string() +
                                            " keeps no map that could be merged; choose line SLAM there");
  }
  return run;
}

bool is_map(const std::filesystem::path& path) { return path.extension() == store::kMapFileEnding; }

Result<MergedLog> take_map(const MergeOptions& o, const std::filesystem::path& path) {
  if (!o.spans.empty()) {
    return fail(Errc::kInvalidArgument,
                path.string() + " is a map: it has no time to take a part of; leave --span out or name its log");
  }
  Result<store::MapFile> file = store::read_map_file(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  MergedLog taken;
  taken.name = path.filename().string();
  taken.run.map = fleet::as_one_robots(std::move(file->map));
  return taken;
}

Result<MergedLog> take_log(const MergeOptions& o, std::size_t index) {
  const std::filesystem::path& log = o.logs[index];
  if (is_map(log)) {
    return take_map(o, log);
  }
  LogSpan span;
  std::string name = log.filename().string();
  if (!o.spans.empty()) {
    const Result<LogSpan> parsed = parse_span(o.spans[index]);
    if (!parsed) {
      return tl::unexpected<Error>(parsed.error());
    }
    span = *parsed;
    name += " " + o.spans[index] + " %";
  }
  Result<SlamRun> run = run_log(o, log, span);
  if (!run) {
    return fail_with_context(name, run.error());
  }
  return MergedLog{name, *std::move(run)};
}

Result<std::vector<fleet::PreparedMap>> prepare(std::vector<MergedLog>& logs) {
  std::vector<fleet::PreparedMap> prepared(logs.size());
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const auto start = Clock::now();
    if (Status taken = prepared[k].update(logs[k].run.map); !taken) {
      return fail_with_context(logs[k].name, taken.error());
    }
    logs[k].prepare_s = seconds_since(start);
  }
  return prepared;
}

/// The trajectory of each joined robot in the joint map, each pose carried by the nearest local map.
Status write_trajectories(const std::filesystem::path& folder, const MergeRun& run) {
  for (const auto& [slot, robot] : run.joint.robots) {
    Trajectory joined = run.logs[slot].run.trajectory;
    for (StampedPose& at : joined) {
      at.map_T_base = robot.to_joint(at.map_T_base);
    }
    const std::string name = "robot-" + std::to_string(slot + 1) + ".tum";
    Status ok = joined.empty() ? Status{} : files::write_file(folder / name, tum_text(joined));
    if (!ok) {
      return ok;
    }
  }
  return {};
}

Status write_results(const MergeOptions& o, const MergeRun& run) {
  std::error_code error;
  std::filesystem::create_directories(o.out, error);
  if (error) {
    return fail(Errc::kIo, "cannot make the folder " + o.out.string() + ": " + error.message());
  }
  if (Status ok = files::write_file(o.out / "report.json", std::string_view(merge_json(run))); !ok) {
    return ok;
  }
  if (Status ok = write_trajectories(o.out, run); !ok) {
    return ok;
  }
  const Result<Image> picture = merge_picture(run);
  if (!picture) {
    return tl::unexpected<Error>(picture.error());
  }
  if (Status ok = image::write_png(o.out / "merged.png", *picture); !ok) {
    return ok;
  }
  store::MapFile file;
  file.origin.name = "merged";
  file.origin.robot_id = "fleet";
  file.map = run.joint.map;
  return store::write_map_file(o.out / ("merged" + std::string(store::kMapFileEnding)), file);
}

}  // namespace

Result<LogSpan> parse_span(const std::string& text) {
  constexpr double kPercent = 100.0;
  double from = 0.0;
  double to = 0.0;
  char dash = '\0';
  char more = '\0';
  std::istringstream in(text);
  const bool two = static_cast<bool>(in >> from >> dash >> to) && dash == '-' && !(in >> more);
  if (!two || !(from >= 0.0) || !(from < to) || !(to <= kPercent)) {
    return fail(Errc::kInvalidArgument,
                "'" + text + "' is no part of a log; write it in per cent of its duration, such as 0-50");
  }
  return LogSpan{from / kPercent, to / kPercent};
}

Result<MergeRun> merge_logs(const MergeOptions& o) {
  if (o.logs.size() < 2 || o.logs.size() > kMaxLogs || (!o.spans.empty() && o.spans.size() != o.logs.size())) {
    return fail(Errc::kInvalidArgument,
                "merging needs 2 to 16 logs or maps, and with --span one span for each of them");
  }
  MergeRun run;
  for (std::size_t k = 0; k < o.logs.size(); ++k) {
    Result<MergedLog> log = take_log(o, k);
    if (!log) {
      return tl::unexpected<Error>(log.error());
    }
    run.logs.push_back(*std::move(log));
  }
  auto prepared = prepare(run.logs);
  if (!prepared) {
    return tl::unexpected<Error>(prepared.error());
  }
  auto start = Clock::now();
  const fleet::MapMerger merger;
  for (std::size_t a = 0; a < run.logs.size(); ++a) {
    for (std::size_t b = a + 1; b < run.logs.size(); ++b) {
      run.pairs.push_back({slot_of(a), slot_of(b), merger.merge((*prepared)[a], (*prepared)[b])});
    }
  }
  fleet::demote_open_cycles(run.pairs);
  run.merge_s = seconds_since(start);
  start = Clock::now();
  std::vector<fleet::RobotMap> maps;
  maps.reserve(run.logs.size());
  for (std::size_t k = 0; k < run.logs.size(); ++k) {
    maps.push_back({slot_of(k), &run.logs[k].run.map});
  }
  Result<fleet::JointMap> joint = fleet::join(maps, fleet::relations_of(run.pairs), 1);
  if (!joint) {
    return tl::unexpected<Error>(joint.error());
  }
  run.joint = *std::move(joint);
  run.join_s = seconds_since(start);
  return run;
}

Status run_merge_command(const MergeOptions& o, std::ostream& out) {
  const Result<MergeRun> run = merge_logs(o);
  if (o.show_progress) {
    std::fprintf(stderr, "\n");
  }
  if (!run) {
    return tl::unexpected<Error>(run.error());
  }
  out << (o.json ? merge_json(*run) : merge_text(*run));
  return o.out.empty() ? Status{} : write_results(o, *run);
}

}  // namespace seeker::lab
