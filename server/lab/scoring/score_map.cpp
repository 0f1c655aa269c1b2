#include "server/lab/scoring/score_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/core/angle.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/scoring/score_report.hpp"
#include "server/lab/scoring/score_walls.hpp"
#include "server/nav/distance_transform.hpp"

namespace seeker::lab {

// Not in an unnamed namespace: argument-dependent look-up would not find it from Fields.
void describe(config::Fields& f, MapScore& score) {
  f.field("points", score.points);
  f.field("median_m", score.median_m);
  f.field("mean_m", score.mean_m);
  f.field("p90_m", score.p90_m);
  f.field("near_share", score.near_share);
  f.field("known_share", score.known_share);
  f.field("reference_T_map", score.reference_T_map);
}

namespace {

/// Distances to the nearest occupied cell, anywhere on the plane.
class Field {
 public:
  explicit Field(const Grid<std::uint8_t>& occupied) : cells_(nav::distance_transform(occupied)) {}

  /// Of the cell that holds the point.
  [[nodiscard]] double coarse_m(const Point2& p) const {
    const CellIndex cell = cells_.frame().cell_of(p);
    return cells_.contains(cell) ? cells_[cell] * cells_.frame().resolution_m : kOutside_m;
  }
  /// Interpolated between the centres of the four cells around the point.
  [[nodiscard]] double fine_m(const Point2& p) const {
    const GridFrame& frame = cells_.frame();
    const Point2 at = (p - frame.origin) / frame.resolution_m - Point2::Constant(0.5);
    const CellIndex low{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
    if (!cells_.contains(low) || !cells_.contains({low.i + 1, low.j + 1})) {
      return coarse_m(p);
    }
    const double u = at.x() - low.i;
    const double v = at.y() - low.j;
    const double below = (1.0 - u) * cells_[low] + u * cells_[{low.i + 1, low.j}];
    const double above = (1.0 - u) * cells_[{low.i, low.j + 1}] + u * cells_[{low.i + 1, low.j + 1}];
    return ((1.0 - v) * below + v * above) * frame.resolution_m;
  }
  [[nodiscard]] const Grid<float>& cells() const { return cells_; }

 private:
  static constexpr double kOutside_m = 1e3;
  Grid<float> cells_;
};

struct Candidate {
  Pose2 reference_T_centre;
  double cost_m = std::numeric_limits<double>::infinity();
};

/// The few best places so far.
class Best {
 public:
  explicit Best(std::size_t count) : places_(count) {}

  [[nodiscard]] double worst_m() const { return places_.back().cost_m; }
  void add(const Candidate& place) {
    const auto at = std::upper_bound(places_.begin(), places_.end(), place,
                                     [](const Candidate& a, const Candidate& b) { return a.cost_m < b.cost_m; });
    if (at != places_.end()) {
      places_.insert(at, place);
      places_.pop_back();
    }
  }
  [[nodiscard]] const std::vector<Candidate>& places() const { return places_; }

 private:
  std::vector<Candidate> places_;
};

/// Range of an axis of the search.
struct Span {
  double low = 0.0;
  double high = 0.0;
};

class Search {
 public:
  Search(const std::vector<Point2>& points, const Field& field, const MapScoreParams& params)
      : points_(points), field_(field), params_(params) {}

  /// Costs of all poses of the three spans on the coarse grid.
  [[nodiscard]] Best coarse(const Span& x, const Span& y, const Span& theta) const {
    Best best(params_.candidates);
    const std::vector<Point2> few = thinned();
    for (double t = theta.low; t <= theta.high; t += params_.coarse_step_rad) {
      std::vector<Point2> rotated;
      rotated.reserve(few.size());
      for (const Point2& point : few) {
        rotated.push_back(Pose2{0.0, 0.0, t} * point);
      }
      Candidate best_here;  // one place a heading keeps the candidates apart
      for (double px = x.low; px <= x.high; px += params_.coarse_step_m) {
        for (double py = y.low; py <= y.high; py += params_.coarse_step_m) {
          const double cost_m = coarse_cost(rotated, {px, py}, best_here.cost_m);
          if (cost_m < best_here.cost_m) {
            best_here = {{px, py, t}, cost_m};
          }
        }
      }
      best.add(best_here);
    }
    return best;
  }

  [[nodiscard]] Candidate refine(Candidate place) const {
    place.cost_m = fine_cost(place.reference_T_centre);
    double step_m = params_.coarse_step_m;
    double step_rad = params_.coarse_step_rad;
    while (step_m > params_.fine_step_m || step_rad > params_.fine_step_rad) {
      if (!improve(place, step_m, step_rad)) {
        step_m *= 0.5;
        step_rad *= 0.5;
      }
    }
    return place;
  }

 private:
  [[nodiscard]] std::vector<Point2> thinned() const {
    std::vector<Point2> few;
    const double stride =
        std::max(1.0, static_cast<double>(points_.size()) / static_cast<double>(params_.coarse_points));
    for (double k = 0.0; k < static_cast<double>(points_.size()); k += stride) {
      few.push_back(points_[static_cast<std::size_t>(k)]);
    }
    return few;
  }
  /// Mean of the capped distances; stops as soon as it is over the limit.
  [[nodiscard]] double coarse_cost(const std::vector<Point2>& rotated, const Point2& shift, double limit_m) const {
    const double stop = limit_m * static_cast<double>(rotated.size());
    double sum = 0.0;
    for (const Point2& point : rotated) {
      sum += std::min(field_.coarse_m(point + shift), params_.coarse_cap_m);
      if (sum > stop) {
        return std::numeric_limits<double>::infinity();
      }
    }
    return sum / static_cast<double>(rotated.size());
  }
  [[nodiscard]] double fine_cost(const Pose2& pose) const {
    double sum = 0.0;
    for (const Point2& point : points_) {
      sum += std::min(field_.fine_m(pose * point), params_.fine_cap_m);
    }
    return sum / static_cast<double>(points_.size());
  }
  /// Takes the best of the six neighbours; false where none is better.
  [[nodiscard]] bool improve(Candidate& place, double step_m, double step_rad) const {
    Candidate best = place;
    for (const Pose2& step : {Pose2{step_m, 0.0, 0.0}, Pose2{-step_m, 0.0, 0.0}, Pose2{0.0, step_m, 0.0},
                              Pose2{0.0, -step_m, 0.0}, Pose2{0.0, 0.0, step_rad}, Pose2{0.0, 0.0, -step_rad}}) {
      const Pose2 pose = place.reference_T_centre * step;
      const double cost_m = fine_cost(pose);
      if (cost_m < best.cost_m) {
        best = {pose, cost_m};
      }
    }
    const bool better = best.cost_m < place.cost_m;
    place = best;
    return better;
  }

  const std::vector<Point2>& points_;
  const Field& field_;
  const MapScoreParams& params_;
};

/// Where the search looks: everywhere in the reference, or around the pose that was given.
std::array<Span, 3> spans_of(const Grid<float>& cells, const Point2& centre_map, const MapScoreParams& params) {
  if (!params.initial) {
    const Point2 low = cells.frame().origin;
    const Point2 high = low + cells.frame().resolution_m * Point2(cells.width(), cells.height());
    return {Span{low.x(), high.x()}, Span{low.y(), high.y()}, Span{-kPi, kPi}};
  }
  const Point2 centre = *params.initial * centre_map;
  const double r = params.initial_range_m;
  const double range_rad = params.initial_range_rad;
  return {Span{centre.x() - r, centre.x() + r}, Span{centre.y() - r, centre.y() + r},
          Span{params.initial->theta_rad - range_rad, params.initial->theta_rad + range_rad}};
}

MapScore score_of(const std::vector<Point2>& points, const Field& field, const RosMap& reference, const Pose2& pose,
                  const MapScoreParams& params) {
  std::vector<double> distances_m;
  MapScore score;
  double within = 0.0;
  for (const Point2& point : points) {
    const Point2 p = pose * point;
    const double d_m = field.fine_m(p);
    distances_m.push_back(d_m);
    const CellIndex cell = reference.known.frame().cell_of(p);
    score.known_share += reference.known.contains(cell) && reference.known[cell] != 0 ? 1.0 : 0.0;
    score.near_share += d_m <= params.near_m ? 1.0 : 0.0;
    score.mean_m += d_m <= params.fine_cap_m ? d_m : 0.0;
    within += d_m <= params.fine_cap_m ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(points.size());
  std::sort(distances_m.begin(), distances_m.end());
  constexpr double kTail = 0.9;
  score.points = points.size();
  score.median_m = distances_m[distances_m.size() / 2];
  score.p90_m = distances_m[static_cast<std::size_t>(kTail * (count - 1.0))];
  score.mean_m = within > 0.0 ? score.mean_m / within : 0.0;
  score.near_share /= count;
  score.known_share /= count;
  return score;
}

}  // namespace

Result<MapScore> score_map(const std::vector<Point2>& points_map, const RosMap& reference,
                           const MapScoreParams& params) {
  if (points_map.empty()) {
    return fail(Errc::kInvalidArgument, "the map has no walls to measure");
  }
  // Rotation about the middle of the points keeps the steps of the search independent.
  Point2 centre = Point2::Zero();
  for (const Point2& point : points_map) {
    centre += point / static_cast<double>(points_map.size());
  }
  std::vector<Point2> points;
  points.reserve(points_map.size());
  for (const Point2& point : points_map) {
    points.emplace_back(point - centre);
  }
  const Field field(reference.occupied);
  const Search search(points, field, params);
  const std::array<Span, 3> spans = spans_of(field.cells(), centre, params);
  Candidate best;
  const Best found = search.coarse(spans[0], spans[1], spans[2]);
  for (const Candidate& place : found.places()) {
    if (std::isfinite(place.cost_m)) {
      const Candidate refined = search.refine(place);
      best = refined.cost_m < best.cost_m ? refined : best;
    }
  }
  MapScore score = score_of(points, field, reference, best.reference_T_centre, params);
  score.reference_T_map = best.reference_T_centre * Pose2{-centre.x(), -centre.y(), 0.0};
  return score;
}

Status run_score_map(const ScoreMapOptions& options, std::ostream& out, std::ostream& notes) {
  const Result<Walls> walls = read_walls(options.walls);
  if (!walls) {
    return tl::unexpected<Error>(walls.error());
  }
  if (const std::string text = complaints(options.walls.string(), walls->bad, {}); !text.empty()) {
    notes << text << "\n";
  }
  const Result<RosMap> reference = read_ros_map(options.map_yaml);
  if (!reference) {
    return tl::unexpected<Error>(reference.error());
  }
  const Result<MapScore> score = score_map(sample_walls(*walls, options.params.sample_m), *reference, options.params);
  if (!score) {
    return tl::unexpected<Error>(score.error());
  }
  if (options.json) {
    out << to_json(*score);
    return {};
  }
  constexpr double kPercent = 100.0;
  Table table({"points", "", "median m", "mean m", "p90 m", "near %", "on known %"});
  table.add({std::to_string(score->points), "", fixed(score->median_m, 4), fixed(score->mean_m, 4),
             fixed(score->p90_m, 4), fixed(kPercent * score->near_share, 1), fixed(kPercent * score->known_share, 1)});
  const Pose2& pose = score->reference_T_map;
  out << table.text() << "reference_T_map: " << fixed(pose.x_m, 3) << " m, " << fixed(pose.y_m, 3) << " m, "
      << fixed(rad_to_deg(pose.theta_rad), 2) << " deg\n";
  return {};
}

}  // namespace seeker::lab
