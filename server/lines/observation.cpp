#include "server/lines/observation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/angle.hpp"
#include "server/lines/scan_circle.hpp"

namespace seeker::lines {
namespace {

/// Beams beyond an end that say whether it is one: most of them must.
constexpr int kVotes = 3;

/// What the observations of one scan share.
struct Context {
  const LaserScan& scan;
  const ScanLines& found;
  const ObservationParams& params;
  double range_limit_m = 0.0;
  bool full_circle = false;
};

/// What one beam beyond an end says about it (spec S1.4, step 4).
enum class Vote : std::uint8_t { kVirtual, kReal };

/// The end of a line: where it is, and the step in beams that leads beyond it.
struct End {
  Point2 point;
  std::size_t beam = 0;
  int outward = 0;  ///< +1 or -1
};

End end_of(const Line& line, bool at_end, const LaserScan& scan) {
  const int counter_clockwise = scan.angle_step_rad > 0.0 ? 1 : -1;
  return at_end ? End{line.end, line.last_beam, counter_clockwise}
                : End{line.start, line.first_beam, -counter_clockwise};
}

/// The beam `steps` beyond the end; nothing outside the field of view.
std::optional<std::size_t> beam_beyond(const Context& context, const End& end, int steps) {
  const auto n = static_cast<std::int64_t>(context.scan.ranges_m.size());
  std::int64_t beam = static_cast<std::int64_t>(end.beam) + static_cast<std::int64_t>(end.outward) * steps;
  if (context.full_circle) {
    beam = (beam + n) % n;
  }
  return beam >= 0 && beam < n ? std::optional(static_cast<std::size_t>(beam)) : std::nullopt;
}

/// Another line that begins at this end in another direction, as at a corner; null where there is none.
const Line* line_around_corner(const Context& context, std::size_t index, const Point2& end) {
  const Line& line = context.found.lines[index];
  for (std::size_t k = 0; k < context.found.lines.size(); ++k) {
    const Line& other = context.found.lines[k];
    const double angle_rad = std::abs(wrap_angle(2.0 * (other.alpha_rad - line.alpha_rad))) / 2.0;
    const double gap_m = std::min((other.start - end).norm(), (other.end - end).norm());
    if (k != index && gap_m <= context.params.corner_gap_m && angle_rad > context.params.corner_angle_rad) {
      return &other;
    }
  }
  return nullptr;
}

Vote vote_of_beam(const Context& context, const Line& line, bool corner, std::size_t beam) {
  const ObservationParams& params = context.params;
  const double cosine = std::cos(context.scan.angle_rad(beam) - line.alpha_rad);
  if (cosine < std::sin(params.grazing_rad)) {
    return Vote::kVirtual;
  }
  const double expected_m = line.r_m / cosine;
  if (expected_m > context.range_limit_m - params.range_margin_m) {
    return Vote::kVirtual;
  }
  if (corner) {
    return Vote::kReal;
  }
  const double range_m = static_cast<double>(context.scan.ranges_m[beam]);
  // No return is +infinity: the beam goes on behind the end, or the wall mirrored it away. An end that is taken for
  // real there moves on with the robot and holds it back.
  if (!std::isfinite(range_m) && cosine < std::sin(params.lost_rad)) {
    return Vote::kVirtual;
  }
  return range_m > expected_m + params.depth_step_m ? Vote::kReal : Vote::kVirtual;
}

/// Distance on the line from an end to where the next beam outward meets the line.
double spacing_m(const Context& context, const Line& line, const End& end) {
  const double flattest_rad = kPi / 2.0 - context.params.grazing_rad;
  const double bearing_rad = wrap_angle(std::atan2(end.point.y(), end.point.x()) - line.alpha_rad);
  const double next_rad = bearing_rad + end.outward * context.scan.angle_step_rad;
  const auto along_m = [&](double rad) { return line.r_m * std::tan(std::clamp(rad, -flattest_rad, flattest_rad)); };
  return std::abs(along_m(next_rad) - along_m(bearing_rad));
}

bool is_real(const Context& context, std::size_t index, const End& end) {
  // Where one beam more or less on the wall moves its end by more than that, the end would creep on with the robot.
  if (spacing_m(context, context.found.lines[index], end) > context.params.end_spacing_m) {
    return false;
  }
  const bool corner = line_around_corner(context, index, end.point) != nullptr;
  int real = 0;
  for (int step = 1; step <= kVotes; ++step) {
    const std::optional<std::size_t> beam = beam_beyond(context, end, step);
    if (beam && vote_of_beam(context, context.found.lines[index], corner, *beam) == Vote::kReal) {
      ++real;
    }
  }
  return 2 * real > kVotes;
}

/// How far beyond the line's last point the wall ends.
struct Beyond {
  double expected_m = 0.0;
  double sigma_m = 0.0;
};

/// Where the beam next to the end hits what leads around the corner, such as the inner side of a door post, along
/// `outward` from the end. Nothing where it goes on to what is farther off.
std::optional<double> hit_around_corner_m(const Context& context, const End& end, const Point2& outward,
                                          double spacing_m) {
  constexpr double kSigmas = 3.0;  // a narrower gate would take those that are read long for misses
  const std::optional<std::size_t> beam = beam_beyond(context, end, 1);
  if (!beam || !std::isfinite(context.scan.ranges_m[*beam])) {
    return std::nullopt;
  }
  const double angle_rad = context.scan.angle_rad(*beam);
  const Point2 hit = context.scan.ranges_m[*beam] * Point2(std::cos(angle_rad), std::sin(angle_rad)) - end.point;
  const double along_m = outward.dot(hit);
  const double across_m = outward.x() * hit.y() - outward.y() * hit.x();
  const double slack_m = kSigmas * context.found.range_sigma_m;
  const bool meets = along_m > -slack_m && along_m < spacing_m + slack_m;
  return meets && std::abs(across_m) <= context.params.corner_gap_m ? std::optional(along_m) : std::nullopt;
}

/// The wall ends at its corner, where one is seen; else somewhere between its last beam and the next.
Beyond beyond_last_point(const Context& context, std::size_t index, const End& end) {
  const Line& line = context.found.lines[index];
  const double range_sigma_m = context.found.range_sigma_m;
  const Point2 outward = (end.point - 0.5 * (line.start + line.end)).normalized();
  if (const Line* other = line_around_corner(context, index, end.point)) {
    const Point2 normal(std::cos(other->alpha_rad), std::sin(other->alpha_rad));
    const double crossing_m = (other->r_m - normal.dot(end.point)) / normal.dot(outward);
    return {std::clamp(crossing_m, -context.params.corner_gap_m, context.params.corner_gap_m), range_sigma_m};
  }
  const double next_m = spacing_m(context, line, end);
  if (const std::optional<double> hit_m = hit_around_corner_m(context, end, outward, next_m)) {
    return {*hit_m, range_sigma_m};
  }
  return {0.5 * next_m, next_m / std::sqrt(12.0)};
}

/// sigma_e of spec S1.4 step 5: noise of the last range along the line, and where beyond its point the end lies.
double end_sigma_m(const Context& context, const Line& line, const End& end, const Beyond& beyond) {
  const double sine = std::min(1.0, line.r_m / std::max(end.point.norm(), std::numeric_limits<double>::min()));
  const double along_m = context.found.range_sigma_m * std::sqrt(1.0 - sine * sine);
  return std::hypot(along_m, beyond.sigma_m);
}

/// SegmentObservation::clear_m of a line at `r_m`: how far from its foot it may end for is_real() to say the same
/// wherever the beams fall. The last beam on the wall and those that vote are within kVotes steps of the end.
double clear_m(const Context& context, double r_m) {
  const ObservationParams& params = context.params;
  const double step_rad = std::abs(context.scan.angle_step_rad);
  const double seen_m = context.range_limit_m - params.range_margin_m;
  const double flattest_rad = kPi / 2.0 - std::max(params.grazing_rad, params.lost_rad);
  const double farthest_rad = std::acos(std::clamp(r_m / seen_m, 0.0, 1.0));
  const double votes_rad = std::min(flattest_rad, farthest_rad) - kVotes * step_rad;
  // r (tan(b + step) - tan(b)) grows with b: at most what is_real() allows, one beam on.
  const double sparsest_rad = std::acos(std::sqrt(std::clamp(r_m * step_rad / params.end_spacing_m, 0.0, 1.0)));
  const double most_rad = std::min(votes_rad, sparsest_rad - 2.0 * step_rad);
  return r_m * std::tan(std::max(0.0, most_rad));
}

bool is_grazed(const Line& line, double grazing_rad) {
  const Point2 middle = 0.5 * (line.start + line.end);
  return line.r_m < std::sin(grazing_rad) * middle.norm();
}

SegmentObservation observe_line(const Context& context, std::size_t index) {
  const Line& line = context.found.lines[index];
  // Facing the wall the larger bearing is on the left: the line's end.
  const std::array<Point2, 2> points{line.end, line.start};
  SegmentObservation seen;
  const Point2 along(std::sin(line.alpha_rad), -std::cos(line.alpha_rad));
  std::array<double, 2> s{along.dot(points[kLeft]), along.dot(points[kRight])};
  for (const Side side : {kLeft, kRight}) {
    const End end = end_of(line, side == kLeft, context.scan);
    seen.real[side] = is_real(context, index, end);
    const Beyond beyond = beyond_last_point(context, index, end);
    seen.end_sigma_m[side] = end_sigma_m(context, line, end, beyond);
    const double beyond_m = seen.real[side] ? beyond.expected_m : 0.0;
    s[side] += side == kLeft ? -beyond_m : beyond_m;
  }
  const double s_m = 0.5 * (s[kLeft] + s[kRight]);
  const Point2 normal(std::cos(line.alpha_rad), std::sin(line.alpha_rad));
  const Point2 middle = line.r_m * normal + s_m * along;
  seen.base_T_segment =
      context.scan.base_T_laser * Pose2{middle.x(), middle.y(), wrap_angle(line.alpha_rad - kPi / 2.0)};
  seen.length_m = s[kRight] - s[kLeft];
  Matrix2 t;
  t << 1.0, s_m, 0.0, 1.0;
  seen.covariance = t * line.covariance * t.transpose();
  seen.covariance(0, 0) += context.params.wall_sigma_m * context.params.wall_sigma_m;
  seen.covariance(1, 1) += context.params.wall_sigma_rad * context.params.wall_sigma_rad;
  seen.beam_step_rad = std::abs(context.scan.angle_step_rad);
  seen.clear_m = clear_m(context, line.r_m);
  seen.foot_x_m = -s_m;
  seen.points = line.points;
  seen.line = index;
  return seen;
}

}  // namespace

std::vector<SegmentObservation> observe(const LaserScan& scan, const ScanLines& found,
                                        const ObservationParams& params) {
  Context context{.scan = scan, .found = found, .params = params};
  context.range_limit_m = params.max_range_m > 0.0 ? params.max_range_m
                          : scan.range_max_m > 0.0 ? scan.range_max_m
                                                   : std::numeric_limits<double>::infinity();
  context.full_circle = circle_of(scan).closed;
  std::vector<SegmentObservation> observations;
  observations.reserve(found.lines.size());
  for (std::size_t k = 0; k < found.lines.size(); ++k) {
    if (!is_grazed(found.lines[k], params.grazing_rad)) {
      observations.push_back(observe_line(context, k));
    }
  }
  return observations;
}

}  // namespace seeker::lines
