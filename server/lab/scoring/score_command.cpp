#include "server/lab/scoring/score_command.hpp"

#include "common/files/files.hpp"
#include "server/lab/scoring/log_poses.hpp"
#include "server/lab/scoring/score_report.hpp"

namespace seeker::lab {
namespace {

void note(std::ostream& notes, const std::string& text) {
  if (!text.empty()) {
    notes << text << "\n";
  }
}

void note_summary(std::ostream& notes, const std::filesystem::path& log, const drivers::ReplaySummary& summary) {
  if (summary.bad > 0 || !summary.damage.empty()) {
    notes << log.string() << ": " << drivers::describe(summary) << "\n";
  }
}

Result<Trajectory> read_poses(const std::filesystem::path& path, std::ostream& notes) {
  Result<TrajectoryFile> file = read_trajectory(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  note(notes, complaints(path.string(), file->bad, file->damage));
  return std::move(file->poses);
}

Status score_by_relations(const ScoreOptions& o, const Trajectory& trajectory, const LogPoses& log, std::ostream& out,
                          std::ostream& notes) {
  const Result<RelationFile> relations = read_relations(o.relations);
  if (!relations) {
    return tl::unexpected<Error>(relations.error());
  }
  note(notes, complaints(o.relations.string(), relations->bad, relations->damage));
  Result<RelationReport> report =
      score_relations(trajectory, log.odometry, relations->relations, log.exact_stamps_s, o.params);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  if (o.exact_only) {
    if (!report->exact || report->exact->used == 0) {
      return fail(Errc::kInvalidArgument, "no relation lies between exactly stamped scans; leave out --exact-only");
    }
    report->missed += report->all.used - report->exact->used;
    report->all = *report->exact;
    report->exact.reset();
  }
  out << (o.json ? relation_json(*report) : relation_text(*report));
  return {};
}

Status score_by_reference(const ScoreOptions& o, const Trajectory& trajectory, const LogPoses& log, std::ostream& out,
                          std::ostream& notes) {
  const bool corrections = !o.corrections.empty();
  Result<Trajectory> reference = read_poses(corrections ? o.corrections : o.reference, notes);
  if (!reference) {
    return tl::unexpected<Error>(reference.error());
  }
  if (corrections) {
    reference = apply_corrections(*reference, log.odometry, o.params.max_gap_s);
  }
  const Result<ReferenceReport> report = score_reference(trajectory, *reference, o.params.max_gap_s);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  out << (o.json ? reference_json(*report) : reference_text(*report));
  return {};
}

}  // namespace

Status run_score(const ScoreOptions& options, std::ostream& out, std::ostream& notes) {
  const int kinds =
      (options.relations.empty() ? 0 : 1) + (options.reference.empty() ? 0 : 1) + (options.corrections.empty() ? 0 : 1);
  if (kinds != 1) {
    return fail(Errc::kInvalidArgument, "name one of --relations, --reference and --corrections");
  }
  if (options.odometry.empty() && (!options.corrections.empty() || options.exact_only)) {
    return fail(Errc::kInvalidArgument, "--corrections and --exact-only need the log: name it with --odometry");
  }
  const Result<Trajectory> trajectory = read_poses(options.trajectory, notes);
  if (!trajectory) {
    return tl::unexpected<Error>(trajectory.error());
  }
  LogPoses log;
  if (!options.odometry.empty()) {
    Result<LogPoses> read = read_log_poses(options.odometry);
    if (!read) {
      return tl::unexpected<Error>(read.error());
    }
    log = std::move(*read);
    note_summary(notes, options.odometry, log.summary);
  }
  return options.relations.empty() ? score_by_reference(options, *trajectory, log, out, notes)
                                   : score_by_relations(options, *trajectory, log, out, notes);
}

Status write_log_trajectory(const std::filesystem::path& log, LogPoseSource source, const std::filesystem::path& out,
                            std::ostream& notes) {
  const Result<LogPoses> poses = read_log_poses(log);
  if (!poses) {
    return tl::unexpected<Error>(poses.error());
  }
  note_summary(notes, log, poses->summary);
  const Trajectory& chosen = source == LogPoseSource::kOdometry ? poses->odometry : poses->corrected;
  if (chosen.empty()) {
    return fail(Errc::kNotReady, log.string() + " holds no poses of this kind; choose another --source");
  }
  return files::write_file(out, tum_text(chosen));
}

}  // namespace seeker::lab
