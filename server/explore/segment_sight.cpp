#include "server/explore/segment_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/polygon.hpp"
#include "server/lines/observation.hpp"
#include "server/nav/ray.hpp"
#include "server/slam/sp_geometry.hpp"

namespace seeker::explore {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Two estimates of one wall lie no farther apart: nearer objects do not hide each other.
constexpr double kSamePlace_m = 0.15;
/// Walls whose headings differ by less than this are pieces of one wall, not a corner.
const double kCornerSine = std::sin(deg_to_rad(20.0));
/// A mapped wall ends this much short of where it really ends: beams are not infinitely dense.
constexpr double kEndSlack_m = 0.10;
/// Nearer to a wall's line than this the robot sees it edge-on.
constexpr double kEdgeOn_m = 0.02;
constexpr double kSample_m = 0.1;  ///< of half-lines, refined where they end
constexpr int kBisections = 6;
/// One crossing may be found from both of its walls: rounding must not make two crossings of it.
constexpr double kRounding_m = 1e-6;

double end_x_m(const SightWall& wall, std::size_t side) { return 0.5 * slam::end_sign(side) * wall.length_m; }

Point2 end_of(const SightWall& wall, std::size_t side) { return wall.map_T_segment * Point2(end_x_m(wall, side), 0.0); }

/// A point so far beyond an end of a wall.
Point2 beyond(const SightWall& wall, std::size_t side, double by_m) {
  return wall.map_T_segment * Point2(end_x_m(wall, side) + slam::end_sign(side) * by_m, 0.0);
}

/// The cell and all around it are free: not even a wall that lies a cell off can be there.
bool surely_free(const Grid<nav::CellState>& floor, const Point2& p_map) {
  const CellIndex middle = floor.frame().cell_of(p_map);
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const CellIndex cell{middle.i + i, middle.j + j};
      if (!floor.contains(cell) || floor[cell] != nav::CellState::kFree) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

SightScene::SightScene(const std::vector<MapSegment>& segments, const Point2& place_map, double reach_m,
                       const OneStepParams& params, const Grid<nav::CellState>* floor)
    : sensor_(params.sensor), corner_gap_m_(params.corner_gap_m), floor_(floor), map_segments_(segments.size()) {
  for (const MapSegment& segment : segments) {
    map_length_m_ += segment.length_m;
    if (distance_to_segment_m(segment.left(), segment.right(), place_map) <= reach_m) {
      walls_.push_back({segment.map_T_segment, segment.length_m, {segment.left_real, segment.right_real}});
    }
  }
  for (std::size_t wall = 0; wall < walls_.size(); ++wall) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (!walls_[wall].real[side]) {
        ends_.push_back({wall, side, 2.0 * sensor_.range_m, false});
        find_stop(ends_.back());
      }
    }
  }
  find_meetings();
}

SightView SightScene::look(const Pose2& map_T_base) const { return {*this, map_T_base}; }

void SightScene::find_stop(OpenEnd& end) const {
  for (std::size_t other = 0; other < walls_.size(); ++other) {
    if (other != end.wall) {
      stop_at_wall(end, walls_[other]);
    }
  }
  if (floor_ != nullptr) {
    stop_at_seen_floor(end);
  }
}

void SightScene::stop_at_wall(OpenEnd& end, const SightWall& other) const {
  const SightWall& wall = walls_[end.wall];
  const Pose2 segment_T_other = inverse(wall.map_T_segment) * other.map_T_segment;
  const double sign = slam::end_sign(end.side);
  const double x_end_m = end_x_m(wall, end.side);
  const double sine = std::sin(segment_T_other.theta_rad);
  const double half_m = 0.5 * other.length_m;
  if (std::abs(sine) > kCornerSine) {
    const double along_other_m = -segment_T_other.y_m / sine;
    const double at_m = sign * (segment_T_other.x_m + along_other_m * std::cos(segment_T_other.theta_rad) - x_end_m);
    if (std::abs(along_other_m) <= half_m + kEndSlack_m && at_m >= -kSamePlace_m && at_m < end.stop_m) {
      end.stop_m = std::max(0.0, at_m);
      end.corner = true;
    }
    return;
  }
  const Point2 a = segment_T_other * Point2(-half_m, 0.0);
  const Point2 b = segment_T_other * Point2(half_m, 0.0);
  const double cosine = std::cos(segment_T_other.theta_rad);
  if (cosine < 0.0 || std::abs(a.y()) > kSamePlace_m || std::abs(b.y()) > kSamePlace_m) {
    return;
  }
  const double near_m = std::min(sign * (a.x() - x_end_m), sign * (b.x() - x_end_m));
  const double far_m = std::max(sign * (a.x() - x_end_m), sign * (b.x() - x_end_m));
  if (far_m > 0.0 && near_m < end.stop_m) {  // the same wall goes on there
    end.stop_m = std::max(0.0, near_m);
    end.corner = false;
  }
}

void SightScene::stop_at_seen_floor(OpenEnd& end) const {
  const double step_m = floor_->frame().resolution_m;
  for (double at_m = step_m; at_m < end.stop_m; at_m += step_m) {
    if (surely_free(*floor_, beyond(walls_[end.wall], end.side, at_m))) {
      end.stop_m = at_m;
      end.corner = false;
      return;
    }
  }
}

void SightScene::find_meetings() {
  for (std::size_t a = 0; a < ends_.size(); ++a) {
    for (std::size_t b = a + 1; b < ends_.size(); ++b) {
      const SightWall& first = walls_[ends_[a].wall];
      const SightWall& second = walls_[ends_[b].wall];
      const Point2 u =
          slam::end_sign(ends_[a].side) * (Pose2{0.0, 0.0, first.map_T_segment.theta_rad} * Point2(1.0, 0.0));
      const Point2 v =
          slam::end_sign(ends_[b].side) * (Pose2{0.0, 0.0, second.map_T_segment.theta_rad} * Point2(1.0, 0.0));
      const double sine = u.x() * v.y() - u.y() * v.x();
      if (std::abs(sine) <= kCornerSine) {
        continue;
      }
      const Point2 between = end_of(second, ends_[b].side) - end_of(first, ends_[a].side);
      const double at_a_m = (between.x() * v.y() - between.y() * v.x()) / sine;
      const double at_b_m = (between.x() * u.y() - between.y() * u.x()) / sine;
      if (std::min(at_a_m, at_b_m) >= -kSamePlace_m && at_a_m <= ends_[a].stop_m + kRounding_m &&
          at_b_m <= ends_[b].stop_m + kRounding_m) {
        meetings_.push_back({{a, b}, {std::max(0.0, at_a_m), std::max(0.0, at_b_m)}});
      }
    }
  }
  std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& one, const Meeting& other) {
    return std::max(one.at_m[0], one.at_m[1]) < std::max(other.at_m[0], other.at_m[1]);
  });
}

SightView::SightView(const SightScene& scene, const Pose2& map_T_base) : scene_(&scene), map_T_base_(map_T_base) {
  const SensorModel& sensor = scene.sensor_;
  const auto beams = static_cast<std::size_t>(std::floor(2.0 * sensor.half_angle_rad / sensor.beam_step_rad)) + 1;
  depth_m_.assign(beams, kInfinity);
  for (const SightWall& wall : scene.walls_) {
    add_wall(wall);
  }
  if (scene.floor_ != nullptr) {
    add_floor();
  }
}

template <class Visit>
void SightView::for_beams(double from_rad, double span_rad, const Visit& visit) const {
  const SensorModel& sensor = scene_->sensor_;
  const double from = wrap_angle(from_rad);
  for (const double start : {from - kTwoPi, from}) {  // an interval over +-180 degrees has two parts
    const double first = std::max(0.0, std::ceil((start + sensor.half_angle_rad) / sensor.beam_step_rad));
    const double last = std::min(static_cast<double>(depth_m_.size()) - 1.0,
                                 std::floor((start + span_rad + sensor.half_angle_rad) / sensor.beam_step_rad));
    for (double k = first; k <= last; k += 1.0) {
      visit(static_cast<std::size_t>(k));
    }
  }
}

SightView::Place SightView::place_at(const SightWall& wall) const {
  const Pose2 segment_T_base = inverse(wall.map_T_segment) * map_T_base_;
  return {segment_T_base.x_m, -segment_T_base.y_m, segment_T_base.theta_rad};
}

void SightView::add_wall(const SightWall& wall) {
  const Place place = place_at(wall);
  if (std::abs(place.ahead_m) < kEdgeOn_m) {
    return;
  }
  const double left_rad = std::atan2(place.ahead_m, -0.5 * wall.length_m - place.x_m);
  const double right_rad = std::atan2(place.ahead_m, 0.5 * wall.length_m - place.x_m);
  const double from_rad = std::min(left_rad, right_rad) - place.heading_rad;
  const SensorModel& sensor = scene_->sensor_;
  for_beams(from_rad, std::abs(left_rad - right_rad), [&](std::size_t beam) {
    const double angle_rad = static_cast<double>(beam) * sensor.beam_step_rad - sensor.half_angle_rad;
    const double range_m = place.ahead_m / std::sin(angle_rad + place.heading_rad);
    if (range_m > 0.0) {
      depth_m_[beam] = std::min(depth_m_[beam], range_m);
    }
  });
}

void SightView::add_floor() {
  const Grid<nav::CellState>& floor = *scene_->floor_;
  const GridFrame& frame = floor.frame();
  const SensorModel& sensor = scene_->sensor_;
  const auto in_cells = [&](const Point2& p) { return Point2((p - frame.origin) / frame.resolution_m); };
  const Point2 from = in_cells(map_T_base_.translation());
  for (std::size_t beam = 0; beam < depth_m_.size(); ++beam) {
    const double angle_rad = static_cast<double>(beam) * sensor.beam_step_rad - sensor.half_angle_rad;
    const double range_m = std::min(sensor.range_m, depth_m_[beam]);
    const Point2 tip = map_T_base_ * Point2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    nav::RayWalk walk(from, in_cells(tip));
    do {
      const CellIndex cell = walk.cell();
      if (floor.contains(cell) && floor[cell] == nav::CellState::kOccupied) {
        depth_m_[beam] = std::min(depth_m_[beam], (frame.centre_of(cell) - map_T_base_.translation()).norm());
        break;
      }
    } while (walk.advance());
  }
}

bool SightView::hidden(std::size_t beam, double range_m, double sine) const {
  return (range_m - depth_m_[beam]) * sine > kSamePlace_m;
}

bool SightView::sees(const Place& place, double x_m) const {
  const SensorModel& sensor = scene_->sensor_;
  const double dx_m = x_m - place.x_m;
  const double range_m = std::hypot(dx_m, place.ahead_m);
  if (place.ahead_m < kEdgeOn_m || range_m > sensor.range_m) {
    return false;
  }
  const double sine = place.ahead_m / range_m;
  const double angle_rad = wrap_angle(std::atan2(place.ahead_m, dx_m) - place.heading_rad);
  if (sine < std::sin(sensor.grazing_rad) || std::abs(angle_rad) > sensor.half_angle_rad) {
    return false;
  }
  const double beam = std::round((angle_rad + sensor.half_angle_rad) / sensor.beam_step_rad);
  return !hidden(std::min(static_cast<std::size_t>(beam), depth_m_.size() - 1), range_m, sine);
}

std::optional<SeenPart> SightView::part_of(const SightWall& wall) const {
  const SensorModel& sensor = scene_->sensor_;
  const Place place = place_at(wall);
  if (place.ahead_m < kEdgeOn_m || place.ahead_m > sensor.range_m) {
    return std::nullopt;
  }
  const double left_rad = std::atan2(place.ahead_m, -0.5 * wall.length_m - place.x_m);
  const double right_rad = std::atan2(place.ahead_m, 0.5 * wall.length_m - place.x_m);
  const double flat = std::sin(sensor.grazing_rad);
  SeenPart part{kInfinity, -kInfinity, 0, {}};
  for_beams(right_rad - place.heading_rad, left_rad - right_rad, [&](std::size_t beam) {
    const double angle_rad =
        static_cast<double>(beam) * sensor.beam_step_rad - sensor.half_angle_rad + place.heading_rad;
    const double sine = std::sin(angle_rad);
    const double range_m = place.ahead_m / sine;
    if (sine < flat || range_m > sensor.range_m || hidden(beam, range_m, sine)) {
      return;
    }
    const double x_m = place.x_m + range_m * std::cos(angle_rad);
    part.from_m = std::min(part.from_m, x_m);
    part.to_m = std::max(part.to_m, x_m);
    ++part.beams;
  });
  if (part.beams == 0) {
    return std::nullopt;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    part.ends[side] = sees(place, end_x_m(wall, side));
  }
  return part;
}

std::optional<double> SightView::extension_m(const OpenEnd& end) const {
  const SightWall& wall = scene_->walls_[end.wall];
  const Place place = place_at(wall);
  const double sign = slam::end_sign(end.side);
  const double x_end_m = end_x_m(wall, end.side);
  if (!sees(place, x_end_m)) {
    return std::nullopt;
  }
  double seen_m = 0.0;
  while (seen_m < end.stop_m) {
    const double next_m = std::min(seen_m + kSample_m, end.stop_m);
    if (sees(place, x_end_m + sign * next_m)) {
      seen_m = next_m;
      continue;
    }
    double beyond_m = next_m;
    for (int k = 0; k < kBisections; ++k) {
      const double middle_m = 0.5 * (seen_m + beyond_m);
      (sees(place, x_end_m + sign * middle_m) ? seen_m : beyond_m) = middle_m;
    }
    break;
  }
  return seen_m;
}

Growth SightView::growth() const {
  std::vector<EndForecast> forecasts(scene_->ends_.size());
  std::vector<bool> in_view(forecasts.size(), false);
  for (std::size_t k = 0; k < forecasts.size(); ++k) {
    const OpenEnd& end = scene_->ends_[k];
    const std::optional<double> seen_m = extension_m(end);
    in_view[k] = seen_m.has_value();
    forecasts[k] = {k, seen_m.value_or(0.0), seen_m.has_value() && end.corner && *seen_m >= end.stop_m - kRounding_m};
  }
  for (const SightScene::Meeting& meeting : scene_->meetings_) {
    const auto reaches = [&](std::size_t k) {
      return in_view[meeting.ends[k]] && forecasts[meeting.ends[k]].extension_m >= meeting.at_m[k] - kRounding_m;
    };
    const std::array<bool, 2> reached{reaches(0), reaches(1)};
    for (std::size_t k = 0; k < 2; ++k) {
      const bool corner = meeting.at_m[1 - k] <= scene_->corner_gap_m_;
      if (reached[k] && (corner || reached[1 - k])) {
        forecasts[meeting.ends[k]].extension_m = meeting.at_m[k];
        forecasts[meeting.ends[k]].becomes_real = corner;
      }
    }
  }
  Growth growth;
  for (std::size_t k = 0; k < forecasts.size(); ++k) {
    growth.extension_m += forecasts[k].extension_m;
    growth.new_ends += forecasts[k].becomes_real ? 1.0 : 0.0;
    if (in_view[k]) {
      growth.ends.push_back(forecasts[k]);
    }
  }
  return growth;
}

}  // namespace seeker::explore
