#include "server/lab/scoring/score_relations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/core/angle.hpp"
#include "server/drivers/replay/words.hpp"

namespace seeker::lab {
namespace {

/// Errors of the relations of one subset.
struct Errors {
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;

  void add(const Pose2& error) {
    translation_m.push_back(std::hypot(error.x_m, error.y_m));
    rotation_deg.push_back(rad_to_deg(std::abs(wrap_angle(error.theta_rad))));
  }
  [[nodiscard]] RelationScore score() const {
    return {translation_m.size(), figures_of(translation_m), figures_of(rotation_deg)};
  }
};

/// The pose at any time, carried from the last entry by the odometry or interpolated.
std::optional<Pose2> carried_pose(const Trajectory& trajectory, const Trajectory& odometry, double stamp_s) {
  const std::optional<std::size_t> last = index_before(trajectory, stamp_s);
  const std::optional<Pose2> odom_T_base = odometry.empty() ? std::nullopt : pose_at(odometry, stamp_s);
  if (!last || !odom_T_base) {
    return pose_at(trajectory, stamp_s);
  }
  const std::optional<Pose2> odom_T_last = pose_at(odometry, trajectory[*last].stamp_s);
  if (!odom_T_last) {
    return pose_at(trajectory, stamp_s);
  }
  return trajectory[*last].map_T_base * (inverse(*odom_T_last) * *odom_T_base);
}

bool near_any(const std::vector<double>& stamps_s, double stamp_s, double within_s) {
  const auto next = std::lower_bound(stamps_s.begin(), stamps_s.end(), stamp_s - within_s);
  return next != stamps_s.end() && *next <= stamp_s + within_s;
}

}  // namespace

Result<std::optional<Relation>> parse_relation_line(std::string_view line) {
  drivers::Words words(line);
  const std::string_view first = drivers::Words(words).word();
  if (first.empty() || first.front() == '#') {
    return std::nullopt;
  }
  Relation relation;
  relation.from_s = words.number();
  relation.to_s = words.number();
  relation.from_T_to.x_m = words.number();
  relation.from_T_to.y_m = words.number();
  words.skip(3);  // dz, roll and pitch of a robot on a floor
  relation.from_T_to.theta_rad = wrap_angle(words.number());
  if (!words.good() || !words.at_end()) {
    return fail(Errc::kParse, "the line is not `t1 t2 dx dy dz roll pitch yaw`");
  }
  return relation;
}

Result<RelationFile> read_relations(const std::filesystem::path& path) {
  Result<drivers::LineFile> file = drivers::LineFile::open(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  RelationFile read;
  std::string line;
  using Line = drivers::LineFile::Line;
  for (Line kind = file->next(line); kind != Line::kEnd; kind = file->next(line)) {
    const Result<std::optional<Relation>> relation =
        kind == Line::kTooLong ? fail(Errc::kParse, "the line is too long") : parse_relation_line(line);
    if (!relation) {
      read.bad.add(file->number(), relation.error().message);
    } else if (*relation) {
      read.relations.push_back(**relation);
    }
  }
  read.damage = file->damage();
  if (read.relations.empty()) {
    return fail(Errc::kParse, path.string() + " holds no relation; it must be lines `t1 t2 dx dy dz roll pitch yaw`");
  }
  return read;
}

ErrorFigures figures_of(std::vector<double> errors) {
  if (errors.empty()) {
    return {};
  }
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  ErrorFigures figures;
  figures.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  double squares = 0.0;
  for (const double error : errors) {
    squares += (error - figures.mean) * (error - figures.mean);
  }
  figures.standard_deviation = std::sqrt(squares / count);
  const std::size_t middle = errors.size() / 2;
  figures.median = errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  figures.max = errors.back();
  return figures;
}

Result<RelationReport> score_relations(const Trajectory& trajectory, const Trajectory& odometry,
                                       const std::vector<Relation>& relations,
                                       const std::vector<double>& exact_stamps_s, const RelationParams& params) {
  Errors all;
  Errors exact;
  RelationReport report;
  for (const Relation& relation : relations) {
    const double from_s = relation.from_s - params.offset_s;
    const double to_s = relation.to_s - params.offset_s;
    const double gap_s = std::max(time_to_nearest_s(trajectory, from_s), time_to_nearest_s(trajectory, to_s));
    const std::optional<Pose2> from = carried_pose(trajectory, odometry, from_s);
    const std::optional<Pose2> to = carried_pose(trajectory, odometry, to_s);
    if (gap_s > params.max_gap_s || !from || !to) {
      ++report.missed;
      continue;
    }
    const Pose2 error = inverse(relation.from_T_to) * (inverse(*from) * *to);
    all.add(error);
    if (near_any(exact_stamps_s, from_s, params.exact_within_s) &&
        near_any(exact_stamps_s, to_s, params.exact_within_s)) {
      exact.add(error);
    }
  }
  if (all.translation_m.empty()) {
    return fail(Errc::kInvalidArgument,
                "no relation lies within the trajectory: state the difference of their clocks with --time-offset");
  }
  report.all = all.score();
  if (!exact_stamps_s.empty()) {
    report.exact = exact.score();
  }
  return report;
}

}  // namespace seeker::lab
