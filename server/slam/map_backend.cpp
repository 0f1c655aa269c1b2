#include "server/slam/map_backend.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

#include "common/core/assert.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::slam {
namespace {

/// A rival may be in any local map that is searched for loops: a loop must be the only pose that fits within that
/// range.
LoopParams with_rivals_of(const LoopPolicy& policy) {
  LoopParams params = policy.detector;
  params.rival_window_m = std::max(params.rival_window_m, policy.max_distance_m);
  return params;
}

}  // namespace

SeenPoints view_of(const MapKeyframe& keyframe, double range_m) {
  SeenPoints seen = seen_points(unpack_scan(keyframe));
  std::erase_if(seen.points, [&](const OrientedPoint& point) { return (point.p - seen.origin).norm() > range_m; });
  return seen;
}

MapBackend::MapBackend(const LoopPolicy& params, const KnownGroundParams& known_ground)
    : params_(params), known_ground_(known_ground), detector_(with_rivals_of(params)) {}

std::uint32_t MapBackend::begin_first(const Pose2& map_T_node, RobotTime stamp) {
  SEEKER_ASSERT(maps_.empty());
  const std::size_t node = graph_.add_node(map_T_node);
  maps_.push_back({static_cast<std::uint32_t>(node), stamp, {}, {}});
  newest_covariance_ = Matrix3::Zero();
  return maps_.back().id;
}

std::uint32_t MapBackend::begin_next(const Pose2& last_T_new, const Matrix3& covariance, RobotTime stamp) {
  SEEKER_ASSERT(!maps_.empty());
  const std::uint32_t last = maps_.back().id;
  const Pose2 map_T_last = pose(last);
  const std::size_t node = graph_.add_node(map_T_last * last_T_new);
  const Result<std::size_t> edge =
      graph_.add_edge({.i = last, .j = node, .i_T_j = last_T_new, .information = information_of(covariance)});
  SEEKER_ASSERT(edge.has_value());
  const Matrix3 to_a = compose_jacobian_a(map_T_last, last_T_new);
  const Matrix3 to_b = compose_jacobian_b(map_T_last, last_T_new);
  newest_covariance_ = to_a * newest_covariance_ * to_a.transpose() + to_b * covariance * to_b.transpose();
  maps_.push_back({static_cast<std::uint32_t>(node), stamp, {}, {}});
  if (own_from_) {
    drop_own_before(last);
  } else if (last > unbroken_from_) {
    forget_known(last - 1);  // the view of the newest reaches into the last, not farther
  }
  return maps_.back().id;
}

void MapBackend::load(const LineMap& map, MapUse use) {
  *this = MapBackend(params_, known_ground_);
  std::map<std::uint32_t, std::uint32_t> number;  // ids in a file may have gaps
  for (const MapNode& node : map.nodes) {
    const auto id = static_cast<std::uint32_t>(graph_.add_node(node.map_T_node));
    number[node.id] = id;
    maps_.push_back({id, node.created, {}, {}});
  }
  for (const MapEdge& edge : map.edges) {
    const Result<std::size_t> added =
        graph_.add_edge({.i = number.at(edge.from),
                         .j = number.at(edge.to),
                         .i_T_j = edge.from_T_to,
                         .information = information_of(edge.covariance),
                         .kernel = edge.loop ? EdgeKernel::kSwitchable : EdgeKernel::kNone,
                         .kernel_width = params_.kernel_width});
    if (added && !edge.enabled) {
      graph_.set_enabled(*added, false);
    }
  }
  for (MapSegment segment : map.segments) {
    const std::uint32_t node = number.at(segment.node);
    segment.node = node;
    segment.map_T_segment = inverse(pose(node)) * segment.map_T_segment;
    maps_[node].segments_node.push_back(segment);
  }
  for (MapKeyframe keyframe : map.keyframes) {
    keyframe.node = number.at(keyframe.node);
    maps_[keyframe.node].keyframes.push_back(std::move(keyframe));
  }
  epoch_ = map.epoch + 1;
  if (use == MapUse::kLocalise) {
    own_from_ = static_cast<std::uint32_t>(maps_.size());
    for (const LocalMap& loaded : maps_) {
      graph_.hold(loaded.id);
    }
  }
}

std::uint32_t MapBackend::begin_apart(RobotTime stamp) {
  const auto id = static_cast<std::uint32_t>(graph_.add_node({}));
  maps_.push_back({id, stamp, {}, {}});
  apart_from_ = apart_from_.value_or(id);
  unbroken_from_ = id;
  counts_.contradictions = 0;
  newest_covariance_ = Matrix3::Zero();
  if (own_from_) {
    // Where those before it lie may be wrong: nothing is searched for in them.
    drop_own_before(id);
  }
  return maps_.back().id;
}

void MapBackend::anchor(const Pose2& map_T_newest, const Matrix3& covariance) {
  SEEKER_ASSERT(apart_from_ && *apart_from_ > 0);
  const std::uint32_t newest = maps_.back().id;
  const Pose2 move = map_T_newest * inverse(pose(newest));
  for (std::uint32_t id = *apart_from_; id <= newest; ++id) {
    graph_.set_pose(id, move * pose(id));
  }
  // The relation is to the local map that shows this place: the one with the nearest scan.
  std::uint32_t nearest = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t id = 0; id < map_end(); ++id) {
    for (const MapKeyframe& keyframe : maps_[id].keyframes) {
      const double away_m = distance_m(pose(id) * keyframe.node_T_base, map_T_newest);
      if (away_m < nearest_m) {
        nearest = id;
        nearest_m = away_m;
      }
    }
  }
  const Pose2 turn{0.0, 0.0, -pose(nearest).theta_rad};
  const Matrix3 rotation = compose_jacobian_b(turn, {});
  relate(nearest, newest, {inverse(pose(nearest)) * map_T_newest, rotation * covariance * rotation.transpose()});
  apart_from_.reset();
  newest_covariance_ = covariance;
  ++epoch_;
}

std::size_t MapBackend::relate(std::size_t i, std::size_t j, const UncertainPose& i_T_j) {
  const Result<std::size_t> edge = graph_.add_edge({.i = i,
                                                    .j = j,
                                                    .i_T_j = i_T_j.a_T_b,
                                                    .information = information_of(i_T_j.covariance),
                                                    .kernel = EdgeKernel::kSwitchable,
                                                    .kernel_width = params_.kernel_width});
  SEEKER_ASSERT(edge.has_value());
  return *edge;
}

std::vector<SeenPoints> MapBackend::seen() const {
  return seen_about(Point2::Zero(), std::numeric_limits<double>::infinity());
}

std::vector<SeenPoints> MapBackend::seen_about(const Point2& p_map, double range_m) const {
  std::vector<SeenPoints> all;
  for (std::uint32_t id = 0; id < map_end(); ++id) {
    for (const MapKeyframe& keyframe : maps_[id].keyframes) {
      const Pose2 map_T_base = pose(id) * keyframe.node_T_base;
      if ((map_T_base.translation() - p_map).norm() <= range_m) {
        all.push_back(transform(map_T_base, view_of(keyframe, params_.view_range_m)));
      }
    }
  }
  return all;
}

std::uint32_t MapBackend::map_end() const {
  return own_from_.value_or(apart_from_.value_or(static_cast<std::uint32_t>(maps_.size())));
}

bool MapBackend::stand_alone(std::uint32_t id) {
  if (unsettled_) {
    unsettled_ = false;
    (void)optimise();  // a relation that is made at poses which the loops still pull at would forget their pull
  }
  const Result<Matrix3> covariance = graph_.relative_covariance(0, id);
  if (!covariance) {
    return false;
  }
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    const PoseEdge& edge = graph_.edge(k);
    if (std::max(edge.i, edge.j) == id) {
      graph_.remove_edge(k);
    }
  }
  relate(0, id, {inverse(pose(0)) * pose(id), *covariance});
  return true;
}

void MapBackend::drop_own_before(std::uint32_t first) {
  const std::uint32_t begin = *own_from_;
  if (first == begin || (!is_apart(first) && !stand_alone(first))) {
    return;
  }
  const std::uint32_t count = first - begin;
  graph_.drop_nodes(begin, first);
  maps_.erase(maps_.begin() + begin, maps_.begin() + first);
  for (std::size_t k = begin; k < maps_.size(); ++k) {
    LocalMap& map = maps_[k];
    map.id -= count;
    for (MapKeyframe& keyframe : map.keyframes) {
      keyframe.node = map.id;
    }
    for (MapSegment& segment : map.segments_node) {
      segment.node = map.id;
    }
  }
  if (apart_from_) {
    apart_from_ = std::max(*apart_from_, first) - count;
  }
  unbroken_from_ = std::max(unbroken_from_, first) - count;
  std::erase_if(pending_, [&](const Surprise& surprise) { return surprise.loop.b < first; });
  for (Surprise& surprise : pending_) {
    surprise.loop.b -= count;
  }
  loop_of_pair_.clear();  // edges have other numbers now, and the newest local map, which gets loops, has none yet
}

std::vector<MapSegment> MapBackend::segments(std::uint32_t end) const {
  std::vector<MapSegment> all;
  for (const LocalMap& map : maps_) {
    if (map.id >= end) {
      break;
    }
    for (MapSegment segment : map.segments_node) {
      segment.map_T_segment = pose(map.id) * segment.map_T_segment;
      all.push_back(segment);
    }
  }
  return all;
}

std::vector<MapPiece> MapBackend::pieces() const {
  std::vector<MapPiece> all;
  const std::uint32_t end = map_end();
  for (const LocalMap& map : maps_) {
    if (map.id >= end) {
      break;
    }
    MapPiece& piece = all.emplace_back(MapPiece{.id = map.id, .map_T_piece = pose(map.id)});
    for (const MapKeyframe& keyframe : map.keyframes) {
      piece.middle_piece += keyframe.node_T_base.translation() / static_cast<double>(map.keyframes.size());
    }
  }
  return all;
}

LineMap MapBackend::assemble(std::uint32_t end) const {
  LineMap whole;
  whole.epoch = epoch_;
  whole.segments = segments(end);
  for (const MapSegment& segment : whole.segments) {
    whole.next_id = std::max(whole.next_id, segment.id + 1);
  }
  for (const LocalMap& map : maps_) {
    if (map.id >= end) {
      break;
    }
    whole.nodes.push_back({map.id, pose(map.id), map.created});
    whole.keyframes.insert(whole.keyframes.end(), map.keyframes.begin(), map.keyframes.end());
  }
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    const PoseEdge& edge = graph_.edge(k);
    if (graph_.enabled(k) && edge.i < end && edge.j < end) {
      whole.edges.push_back({static_cast<std::uint32_t>(edge.i), static_cast<std::uint32_t>(edge.j), edge.i_T_j,
                             edge.information.inverse(), edge.kernel != EdgeKernel::kNone, true});
    }
  }
  return whole;
}

}  // namespace seeker::slam
