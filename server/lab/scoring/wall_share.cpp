#include "server/lab/scoring/wall_share.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/slam/scan_matcher.hpp"

namespace seeker::lab {
namespace {

constexpr double kAlignStep_m = 0.05;

double distance_to(const sim::Segment& segment, const Point2& p) {
  const double along_m = std::clamp((p - segment.a).dot(segment.direction), 0.0, segment.length_m);
  return (p - (segment.a + along_m * segment.direction)).norm();
}

/// Calls `visit(point)` at even steps, both ends included.
template <class Visit>
void sample(const sim::Segment& segment, double step_m, Visit&& visit) {
  const int steps = std::max(1, static_cast<int>(std::ceil(segment.length_m / step_m)));
  for (int n = 0; n <= steps; ++n) {
    visit(Point2(segment.a + segment.length_m * n / steps * segment.direction));
  }
}

/// A mapped segment in the frame `world`.
struct Placed {
  sim::Segment line;
  Point2 normal;  ///< towards the free side
};

std::vector<Placed> place(const std::vector<MapSegment>& segments, const Pose2& world_T_map) {
  std::vector<Placed> placed;
  placed.reserve(segments.size());
  for (const MapSegment& segment : segments) {
    if (segment.length_m <= 0.0) {
      continue;
    }
    const Pose2 world_T_segment = world_T_map * segment.map_T_segment;
    const Point2 along(std::cos(world_T_segment.theta_rad), std::sin(world_T_segment.theta_rad));
    placed.push_back({{world_T_map * segment.left(), along, segment.length_m}, Point2(along.y(), -along.x())});
  }
  return placed;
}

bool is_mapped(const WallPiece& piece, const std::vector<Placed>& map, const WallShareParams& params) {
  const double least_cosine = std::cos(params.parallel_rad);
  return std::any_of(map.begin(), map.end(), [&](const Placed& placed) {
    return placed.normal.dot(piece.normal) >= least_cosine && distance_to(placed.line, piece.p_world) <= params.near_m;
  });
}

/// Length of the part of a segment that has nothing solid near it.
double false_length(const Placed& placed, const TrueWalls& walls, const WallShareParams& params) {
  int samples = 0;
  int lonely = 0;
  sample(placed.line, params.sample_m, [&](const Point2& p) {
    ++samples;
    const auto near = [&](const sim::Segment& surface) { return distance_to(surface, p) <= params.near_m; };
    lonely += std::any_of(walls.walls.begin(), walls.walls.end(), near) ||
                      std::any_of(walls.furniture.begin(), walls.furniture.end(), near)
                  ? 0
                  : 1;
  });
  return placed.line.length_m * lonely / samples;
}

}  // namespace

std::optional<Pose2> align_walls(const std::vector<MapSegment>& segments, const TrueWalls& walls, const Pose2& guess) {
  std::vector<slam::OrientedPoint> truth;
  truth.reserve(walls.reachable.size());
  for (const WallPiece& piece : walls.reachable) {
    truth.push_back({piece.p_world, piece.normal});
  }
  for (const sim::Segment& face : walls.furniture) {
    const Point2 normal(face.direction.y(), -face.direction.x());
    sample(face, kAlignStep_m, [&](const Point2& p) { truth.push_back({p, normal}); });
  }
  std::vector<slam::OrientedPoint> points_map;
  for (const Placed& placed : place(segments, Pose2{})) {
    sample(placed.line, 2.0 * kAlignStep_m, [&](const Point2& p) { points_map.push_back({p, placed.normal}); });
  }
  if (truth.empty() || points_map.empty()) {
    return std::nullopt;
  }
  slam::MatchParams params;
  params.max_iterations = 40;
  params.first_gate_m = 1.2;
  params.last_gate_m = 0.4;
  params.gate_shrink = 0.85;
  params.huber_m = 0.05;
  params.inlier_m = 0.3;
  const slam::ReferenceCloud reference(std::move(truth));
  const slam::MatchResult match = slam::ScanMatcher(params).match(reference, points_map, guess);
  return match.pairs >= params.min_pairs ? std::optional<Pose2>(match.map_T_base) : std::nullopt;
}

WallShare share_of_walls(const std::vector<MapSegment>& segments, const TrueWalls& walls,
                         const Pose2& guess_world_T_map, const WallShareParams& params) {
  WallShare share;
  const std::optional<Pose2> aligned = align_walls(segments, walls, guess_world_T_map);
  share.aligned = aligned.has_value();
  share.world_T_map = aligned.value_or(guess_world_T_map);
  share.reachable_m = walls.reachable_m();
  const std::vector<Placed> map = place(segments, share.world_T_map);
  for (const WallPiece& piece : walls.reachable) {
    if (is_mapped(piece, map, params)) {
      share.mapped_m += piece.length_m;
    } else {
      share.missing.push_back(piece);
    }
  }
  for (const Placed& placed : map) {
    share.map_m += placed.line.length_m;
    share.false_m += false_length(placed, walls, params);
  }
  return share;
}

}  // namespace seeker::lab
