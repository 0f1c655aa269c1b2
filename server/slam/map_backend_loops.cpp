// Loops between local maps: search, acceptance and use.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "common/core/assert.hpp"
#include "server/slam/covariance.hpp"
#include "server/slam/map_backend.hpp"

namespace seeker::slam {

std::uint32_t MapBackend::loop_end() const {
  // Not the newest and not the one before it: the path between those two is an edge already.
  const auto size = static_cast<std::uint32_t>(maps_.size());
  return own_from_.value_or(size < 2 ? 0 : size - 2);
}

std::vector<MapBackend::Candidate> MapBackend::candidates(const Pose2& map_T_base) const {
  std::vector<Candidate> near;
  for (std::uint32_t k = 0; k < loop_end(); ++k) {
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

MapBackend::View MapBackend::newest_view() const {
  View view;
  const Pose2& map_T_newest = pose(maps_.back().id);
  // A local map that has just begun shows little: the end of the one before it belongs to the view.
  for (std::size_t k = maps_.size(); k-- > unbroken_from_ && k + 2 >= maps_.size();) {
    const Pose2 newest_T_node = inverse(map_T_newest) * pose(maps_[k].id);
    const std::vector<MapKeyframe>& keyframes = maps_[k].keyframes;
    for (std::size_t i = keyframes.size(); i-- > 0 && view.seen_node.size() < params_.query_keyframes;) {
      const MapKeyframe& keyframe = keyframes[i];
      view.last = view.seen_node.empty() ? keyframe.stamp : view.last;
      view.first = keyframe.stamp;
      view.seen_node.push_back(
          transform(newest_T_node * keyframe.node_T_base, view_of(keyframe, params_.view_range_m)));
    }
  }
  return view;
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
  if (id < loop_end() && place && expected) {
    const View view = newest_view();
    const auto loop = detector_.verify(view.seen_node, {.id = id, .place = place, .target_T_query = *expected});
    if (!loop) {
      note_refusal(view, *place, *expected);
    }
    for (const LoopEdge& edge :
         loop ? believed({id, newest, loop->target_T_query}, view, *expected) : std::vector<LoopEdge>{}) {
      add_loop(edge);
      unsettled_ = true;
      counts_.contradictions = 0;
    }
  }
  if (!planned_.empty() || !unsettled_) {
    return false;
  }
  unsettled_ = false;
  return optimise();
}

void MapBackend::note_refusal(const View& view, const PlaceMap& place, const UncertainPose& expected) {
  // Most refusals say nothing, for the two hardly overlap. Scans that were counted once are no second contradiction.
  if (!own_from_ || view.seen_node.empty() || (contradicted_by_ && view.first <= *contradicted_by_)) {
    return;
  }
  const Agreement agreement =
      agreement_of(place.pyramid(), place.free_space(), view.seen_node, expected.a_T_b, params_.detector.agreement);
  if (agreement.disagreement() >= params_.contradiction) {
    ++counts_.contradictions;
    contradicted_by_ = view.last;
  }
}

std::vector<LoopEdge> MapBackend::believed(const LoopEdge& loop, const View& view, const UncertainPose& expected) {
  const Pose2 off = inverse(expected.a_T_b) * loop.a_T_b.a_T_b;
  const Matrix3 turn = compose_jacobian_b(expected.a_T_b, {});
  const Eigen::Vector3d residual = turn * Eigen::Vector3d(off.x_m, off.y_m, off.theta_rad);
  const Matrix3 covariance = expected.covariance + loop.a_T_b.covariance;
  if (residual.dot(covariance.inverse() * residual) <= params_.surprise_chi2) {
    return {loop};
  }
  ++counts_.surprises;
  pending_.push_back({loop, view.first, view.last});
  if (pending_.size() > params_.max_pending) {
    pending_.erase(pending_.begin());
  }
  return witnessed();
}

std::vector<LoopEdge> MapBackend::witnessed() {
  std::vector<LoopEdge> candidates;
  for (const Surprise& surprise : pending_) {
    candidates.push_back(surprise.loop);
  }
  const auto odometry = [this](std::size_t from, std::size_t to) {
    return from == to ? UncertainPose{} : relative(from, to).value();
  };
  // Where one view is taken for another place, it agrees with itself, whichever local maps it is compared with.
  const auto share_no_scan = [this](std::size_t i, std::size_t j) {
    return pending_[i].last < pending_[j].first || pending_[j].last < pending_[i].first;
  };
  const ConsistentSet agreed = largest_consistent_set(candidates, odometry, {}, share_no_scan);
  const auto is_newest = [&](std::size_t member) { return member + 1 == candidates.size(); };
  const bool includes_newest = std::any_of(agreed.members.begin(), agreed.members.end(), is_newest);
  if (agreed.members.size() < params_.witnesses || agreed.rival_size >= agreed.members.size() || !includes_newest) {
    return {};
  }
  std::vector<LoopEdge> loops;
  for (const std::vector<std::size_t>* some : {&agreed.members, &agreed.followers}) {
    for (const std::size_t member : *some) {
      loops.push_back(candidates[member]);
    }
  }
  pending_.clear();
  return loops;
}

void MapBackend::add_loop(const LoopEdge& loop) {
  const auto old = loop_of_pair_.find({loop.a, loop.b});
  if (old != loop_of_pair_.end()) {
    graph_.remove_edge(old->second);
  }
  loop_of_pair_[{loop.a, loop.b}] = relate(loop.a, loop.b, loop.a_T_b);
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
  if (!moved || own_from_) {
    return false;  // in a map that is only read the robot has moved, not the map
  }
  ++epoch_;
  return true;
}

}  // namespace seeker::slam
