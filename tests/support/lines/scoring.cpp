#include "tests/support/lines/scoring.hpp"

#include <cmath>
#include <map>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/lines/line_fit.hpp"

namespace seeker::testing {
namespace {

Point2 true_point(const TrueScan& truth, std::size_t beam) {
  const double angle = truth.scan.angle_rad(beam);
  return truth.true_range_m[beam] * Point2(std::cos(angle), std::sin(angle));
}

void describe_run(const Room& room, const TrueScan& truth, const ScoringParams& params, WallRun& run) {
  const RoomWall& wall = room[static_cast<std::size_t>(run.wall)];
  const Point2 along = (wall.b - wall.a).normalized();
  Point2 normal(-along.y(), along.x());
  run.r_m = normal.dot(wall.a);
  if (run.r_m < 0.0) {
    run.r_m = -run.r_m;
    normal = -normal;
  }
  run.alpha_rad = std::atan2(normal.y(), normal.x());
  run.length_m = (true_point(truth, run.beams.back()) - true_point(truth, run.beams.front())).norm();
  const double band_m = params.band_length * params.min_length_m;
  const auto points = static_cast<int>(run.beams.size());
  run.required = run.length_m >= params.min_length_m + band_m && points >= params.min_points + params.band_points;
  run.allowed = run.length_m >= params.min_length_m - band_m && points >= params.min_points - params.band_points;
}

}  // namespace

std::vector<WallRun> wall_runs(const Room& room, const TrueScan& truth, const ScoringParams& params) {
  std::vector<WallRun> runs;
  const auto& walls = truth.wall_of_beam;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    if (walls[k] < 0) {
      continue;
    }
    if (k == 0 || walls[k - 1] != walls[k]) {
      runs.push_back({.wall = walls[k], .beams = {}});
    }
    runs.back().beams.push_back(k);
  }
  const double turn_rad = std::abs(truth.scan.angle_step_rad) * static_cast<double>(walls.size());
  const bool closed = std::abs(turn_rad - kTwoPi) < std::abs(truth.scan.angle_step_rad);
  if (closed && runs.size() > 1 && walls.front() >= 0 && walls.front() == walls.back()) {
    runs.back().beams.insert(runs.back().beams.end(), runs.front().beams.begin(), runs.front().beams.end());
    runs.erase(runs.begin());
  }
  for (WallRun& run : runs) {
    describe_run(room, truth, params, run);
  }
  return runs;
}

double LineScore::r_spread_m() const { return std::sqrt(dr2_m2 / std::max(matches, 1)); }
double LineScore::alpha_spread_rad() const { return std::sqrt(dalpha2_rad2 / std::max(matches, 1)); }

void score_scan(const std::vector<WallRun>& runs, const lines::ScanLines& found, const ScoringParams& params,
                LineScore& score) {
  std::vector<bool> matched(found.lines.size(), false);
  for (const WallRun& run : runs) {
    std::map<std::int32_t, int> beams;
    for (const std::size_t beam : run.beams) {
      ++beams[found.line_of_beam[beam]];
    }
    bool run_found = false;
    for (const auto& [index, count] : beams) {
      if (index < 0 || count < params.beams_share * static_cast<double>(run.beams.size())) {
        continue;
      }
      const lines::Line& line = found.lines[static_cast<std::size_t>(index)];
      const double dalpha = wrap_angle(line.alpha_rad - run.alpha_rad);
      const double dr = line.r_m - run.r_m;
      if (std::abs(dalpha) >= params.alpha_gate_rad || std::abs(dr) >= params.r_gate_m || !run.allowed) {
        continue;
      }
      matched[static_cast<std::size_t>(index)] = true;
      run_found = true;
      ++score.matches;
      score.dr2_m2 += dr * dr;
      score.dalpha2_rad2 += dalpha * dalpha;
      const Eigen::Vector2d error(dr, dalpha);
      const double determinant = line.covariance.determinant();
      const double nees = determinant > 0.0 ? error.dot(line.covariance.inverse() * error) : 0.0;
      score.nees += nees;
      score.nees_of_match.push_back(nees);
    }
    score.required += run.required ? 1 : 0;
    score.required_found += run.required && run_found ? 1 : 0;
  }
  for (const bool hit : matched) {
    ++score.lines;
    score.false_lines += hit ? 0 : 1;
  }
}

lines::ScanLines oracle_lines(const std::vector<WallRun>& runs, const TrueScan& truth) {
  lines::ScanLines found;
  found.line_of_beam.assign(truth.scan.ranges_m.size(), lines::kNoLine);
  for (const WallRun& run : runs) {
    if (!run.allowed) {
      continue;
    }
    lines::Moments sums;
    for (const std::size_t beam : run.beams) {
      const double angle = truth.scan.angle_rad(beam);
      const auto range = static_cast<double>(truth.scan.ranges_m[beam]);
      sums.add(range * std::cos(angle), range * std::sin(angle), 1.0);
      found.line_of_beam[beam] = static_cast<std::int32_t>(found.lines.size());
    }
    const lines::LineFit fit = lines::fit_line(sums);
    lines::Line line;
    line.r_m = fit.r_m;
    line.alpha_rad = fit.alpha_rad();
    found.lines.push_back(line);
  }
  return found;
}

}  // namespace seeker::testing
