#include "server/slam/map_backend.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/slam/reference_cloud.hpp"
#include "server/slam/scan_matcher.hpp"

namespace seeker::slam {
namespace {

Matrix3 information_of(const Matrix3& covariance) {
  const Matrix3 information = covariance.inverse();
  return 0.5 * (information + information.transpose());
}

Matrix3 with_floor(const Matrix3& covariance, double sigma_m, double sigma_rad) {
  return covariance + Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal().toDenseMatrix();
}

}  // namespace

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

bool MapBackend::close_loops(const std::vector<OrientedPoint>& points_node, const Pose2& node_T_base) {
  bool found = false;
  for (const Candidate& candidate : candidates(pose(maps_.back().id) * node_T_base)) {
    ++counts_.tried;
    const bool closed = try_loop(candidate, points_node, node_T_base);
    ++(closed ? counts_.closed : counts_.refused);
    found = found || closed;
  }
  return found && optimise();
}

bool MapBackend::try_loop(const Candidate& candidate, const std::vector<OrientedPoint>& points_node,
                          const Pose2& node_T_base) {
  const LocalMap& map = maps_[candidate.id];
  const Pose2 guess = inverse(pose(map.id)) * pose(maps_.back().id);  // old_T_newest
  const Pose2 old_T_base = guess * node_T_base;
  std::vector<std::pair<double, const MapKeyframe*>> order;
  for (const MapKeyframe& keyframe : map.keyframes) {
    order.emplace_back(distance_m(keyframe.node_T_base, old_T_base), &keyframe);
  }
  std::sort(order.begin(), order.end());
  std::vector<OrientedPoint> reference_points;
  for (std::size_t k = 0; k < std::min(order.size(), params_.keyframes); ++k) {
    const MapKeyframe& keyframe = *order[k].second;
    for (const OrientedPoint& point : oriented_points(unpack_scan(keyframe))) {
      reference_points.push_back(transform(keyframe.node_T_base, point));
    }
  }
  const ReferenceCloud reference(std::move(reference_points));
  const ScanMatcher matcher;
  MatchResult match = matcher.match(reference, points_node, guess);
  if (const auto start = matcher.search(reference, points_node, guess)) {
    MatchResult other = matcher.match(reference, points_node, *start);
    if (other.inliers > match.inliers) {
      match = std::move(other);
    }
  }
  if (match.inlier_ratio < params_.min_overlap || match.rms_m > params_.max_rms_m || !match.converged) {
    return false;
  }
  add_loop(map.id, match.map_T_base, with_floor(match.covariance, params_.sigma_m, params_.sigma_rad));
  return true;
}

void MapBackend::add_loop(std::uint32_t from, const Pose2& from_T_newest, const Matrix3& covariance) {
  const std::uint32_t to = maps_.back().id;
  const auto old = loop_of_pair_.find({from, to});
  if (old != loop_of_pair_.end()) {
    graph_.remove_edge(old->second);
  }
  const Result<std::size_t> edge = graph_.add_edge({.i = from,
                                                    .j = to,
                                                    .i_T_j = from_T_newest,
                                                    .information = information_of(covariance),
                                                    .kernel = EdgeKernel::kSwitchable,
                                                    .kernel_width = params_.kernel_width});
  SEEKER_ASSERT(edge.has_value());
  loop_of_pair_[{from, to}] = *edge;
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

LineMap MapBackend::assemble() const {
  LineMap whole;
  whole.epoch = epoch_;
  for (const LocalMap& map : maps_) {
    whole.nodes.push_back({map.id, pose(map.id), map.created});
    for (seeker::MapSegment segment : map.segments_node) {
      segment.map_T_segment = pose(map.id) * segment.map_T_segment;
      whole.segments.push_back(segment);
    }
    whole.keyframes.insert(whole.keyframes.end(), map.keyframes.begin(), map.keyframes.end());
  }
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    const PoseEdge& edge = graph_.edge(k);
    whole.edges.push_back({static_cast<std::uint32_t>(edge.i), static_cast<std::uint32_t>(edge.j), edge.i_T_j,
                           edge.information.inverse(), edge.kernel != EdgeKernel::kNone, graph_.enabled(k)});
  }
  return whole;
}

}  // namespace seeker::slam
