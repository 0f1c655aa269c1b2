#include "server/slam/map_backend.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::slam {
SeenPoints view_of(const MapKeyframe& keyframe, double range_m) {
  SeenPoints seen = seen_points(unpack_scan(keyframe));
  std::erase_if(seen.points, [&](const OrientedPoint& point) { return (point.p - seen.origin).norm() > range_m; });
  return seen;
}

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
  return maps_.back().id;
}

void MapBackend::load(const LineMap& map) {
  *this = MapBackend(params_);
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
}

std::uint32_t MapBackend::begin_apart(RobotTime stamp) {
  const auto id = static_cast<std::uint32_t>(graph_.add_node({}));
  maps_.push_back({id, stamp, {}, {}});
  apart_from_ = apart_from_.value_or(id);
  newest_covariance_ = Matrix3::Zero();
  return id;
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
  for (std::uint32_t id = 0; id < *apart_from_; ++id) {
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
  const Result<std::size_t> edge =
      graph_.add_edge({.i = nearest,
                       .j = newest,
                       .i_T_j = inverse(pose(nearest)) * map_T_newest,
                       .information = information_of(rotation * covariance * rotation.transpose())});
  SEEKER_ASSERT(edge.has_value());
  apart_from_.reset();
  newest_covariance_ = covariance;
  ++epoch_;
}

std::vector<SeenPoints> MapBackend::seen() const {
  std::vector<SeenPoints> all;
  for (const LocalMap& map : maps_) {
    if (apart_from_ && map.id >= *apart_from_) {
      break;
    }
    for (const MapKeyframe& keyframe : map.keyframes) {
      all.push_back(transform(pose(map.id) * keyframe.node_T_base, view_of(keyframe, params_.view_range_m)));
    }
  }
  return all;
}

void MapBackend::forget_scans_from(std::uint32_t first) {
  for (std::size_t id = first; id + 2 < maps_.size(); ++id) {
    maps_[id].keyframes = {};
    maps_[id].segments_node = {};
  }
}

std::vector<MapBackend::Candidate> MapBackend::candidates(const Pose2& map_T_base) const {
  std::vector<Candidate> near;
  // Not the newest and not the one before it: the way between those two is an edge already.
  for (std::size_t k = 0; k + 2 < maps_.size(); ++k) {
    const LocalMap& map = maps_[k];
    const Pose2 node_T_base = inverse(pose(map.id)) * map_T_base;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const MapKeyframe& keyframe : map.keyframes) {
      nearest_m = std::min(nearest_m, distance_m(keyframe.node_T_base, node_T_base));
    }
    if (nearest_m <= params_.max_distance_m) {
      near.push_back({map.id, nearest_m});
    }
  }
  std::sort(near.begin(), near.end(),
            [](const Candidate& a, const Candidate& b) { return a.distance_m < b.distance_m; });
  if (near.size() > static_cast<std::size_t>(params_.max_candidates)) {
    near.resize(static_cast<std::size_t>(params_.max_candidates));
  }
  return near;
}

std::vector<SeenPoints> MapBackend::query() const {
  std::vector<SeenPoints> seen;
  const Pose2& map_T_newest = pose(maps_.back().id);
  // A local map that has just begun shows little: the end of the one before it belongs to the view.
  for (std::size_t k = maps_.size(); k-- > 0 && k + 2 >= maps_.size();) {
    const Pose2 newest_T_node = inverse(map_T_newest) * pose(maps_[k].id);
    const std::vector<MapKeyframe>& keyframes = maps_[k].keyframes;
    for (std::size_t i = keyframes.size(); i-- > 0 && seen.size() < params_.query_keyframes;) {
      seen.push_back(transform(newest_T_node * keyframes[i].node_T_base, view_of(keyframes[i], params_.view_range_m)));
    }
  }
  return seen;
}

std::shared_ptr<const PlaceMap> MapBackend::place_of(std::uint32_t id) {
  const auto known = std::find_if(places_.begin(), places_.end(), [&](const auto& place) { return place.first == id; });
  if (known != places_.end()) {
    std::rotate(places_.begin(), known, known + 1);
    return places_.front().second;
  }
  std::vector<SeenPoints> seen;
  for (const MapKeyframe& keyframe : maps_[id].keyframes) {
    seen.push_back(transform(keyframe.node_T_base, view_of(keyframe, params_.view_range_m)));
  }
  Result<PlaceMap> built = PlaceMap::build(seen, params_.place);
  if (!built) {
    return nullptr;  // nothing but open space was seen there
  }
  places_.emplace_front(id, std::make_shared<const PlaceMap>(*std::move(built)));
  if (places_.size() > params_.cached_places) {
    places_.pop_back();
  }
  return places_.front().second;
}

std::optional<UncertainPose> MapBackend::relative(std::size_t from, std::size_t to) {
  const Result<Matrix3> covariance = graph_.relative_covariance(from, to);
  if (!covariance) {
    return std::nullopt;
  }
  return UncertainPose{inverse(graph_.pose(from)) * graph_.pose(to), *covariance};
}

void MapBackend::plan_loops(const Pose2& node_T_base) {
  // Scans far apart come before all planned has been tried: first the one, then the other, or the queue grows for ever.
  if (apart() || !planned_.empty()) {
    return;
  }
  for (const Candidate& candidate : candidates(pose(maps_.back().id) * node_T_base)) {
    planned_.push_back(candidate.id);
  }
}

bool MapBackend::step_loops() {
  if (planned_.empty() || apart()) {
    planned_.clear();
    return false;
  }
  const std::uint32_t id = planned_.front();
  planned_.pop_front();
  const std::uint32_t newest = maps_.back().id;
  ++counts_.tried;
  const std::shared_ptr<const PlaceMap> place = place_of(id);
  const std::optional<UncertainPose> expected = relative(id, newest);
  if (id + 1 < newest && place && expected) {
    const auto loop = detector_.verify(query(), {.id = id, .place = place, .target_T_query = *expected});
    for (const LoopEdge& edge :
         loop ? believed({id, newest, loop->target_T_query}, *expected) : std::vector<LoopEdge>{}) {
      add_loop(edge);
      unsettled_ = true;
    }
  }
  if (!planned_.empty() || !unsettled_) {
    return false;
  }
  unsettled_ = false;
  return optimise();
}

std::vector<LoopEdge> MapBackend::believed(const LoopEdge& loop, const UncertainPose& expected) {
  const Pose2 off = inverse(expected.a_T_b) * loop.a_T_b.a_T_b;
  const Matrix3 turn = compose_jacobian_b(expected.a_T_b, {});
  const Eigen::Vector3d residual = turn * Eigen::Vector3d(off.x_m, off.y_m, off.theta_rad);
  const Matrix3 covariance = expected.covariance + loop.a_T_b.covariance;
  if (residual.dot(covariance.inverse() * residual) <= params_.surprise_chi2) {
    return {loop};
  }
  ++counts_.surprises;
  pending_.push_back(loop);
  if (pending_.size() > params_.max_pending) {
    pending_.erase(pending_.begin());
  }
  const ConsistentSet agreed = largest_consistent_set(pending_, [this](std::size_t from, std::size_t to) {
    return from == to ? UncertainPose{} : relative(from, to).value();
  });
  const bool includes_newest = !agreed.members.empty() && agreed.members.back() + 1 == pending_.size();
  if (agreed.members.size() < params_.witnesses || agreed.rival_size >= agreed.members.size() || !includes_newest) {
    return {};
  }
  std::vector<LoopEdge> loops;
  for (const std::size_t member : agreed.members) {
    loops.push_back(pending_[member]);
  }
  pending_.clear();
  return loops;
}

void MapBackend::add_loop(const LoopEdge& loop) {
  const auto old = loop_of_pair_.find({loop.a, loop.b});
  if (old != loop_of_pair_.end()) {
    graph_.remove_edge(old->second);
  }
  const Result<std::size_t> edge = graph_.add_edge({.i = loop.a,
                                                    .j = loop.b,
                                                    .i_T_j = loop.a_T_b.a_T_b,
                                                    .information = information_of(loop.a_T_b.covariance),
                                                    .kernel = EdgeKernel::kSwitchable,
                                                    .kernel_width = params_.kernel_width});
  SEEKER_ASSERT(edge.has_value());
  loop_of_pair_[{loop.a, loop.b}] = *edge;
  ++counts_.closed;
}

bool MapBackend::optimise() {
  const std::uint32_t newest = maps_.back().id;
  const Pose2 before = pose(newest);
  const Result<OptimiseReport> report = graph_.optimise();
  if (!report) {
    return false;
  }
  if (const Result<Matrix3> covariance = graph_.relative_covariance(0, newest)) {
    const Pose2 turn{0.0, 0.0, pose(0).theta_rad};
    const Matrix3 rotation = compose_jacobian_b(turn, {});
    newest_covariance_ = rotation * *covariance * rotation.transpose();
  }
  const Pose2 change = inverse(before) * pose(newest);
  const bool moved =
      std::hypot(change.x_m, change.y_m) > params_.moved_m || std::abs(change.theta_rad) > params_.moved_rad;
  epoch_ += moved ? 1 : 0;
  return moved;
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
