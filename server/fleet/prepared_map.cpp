#include "server/fleet/prepared_map.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"
#include "server/slam/map_backend.hpp"

namespace seeker::fleet {
namespace {

using Keyframes = std::vector<const MapKeyframe*>;

/// Square tiles whose corners are at most `region_m` from their middle.
double tile_size_m(const PreparedMapParams& params) { return std::sqrt(2.0) * params.region_m; }

std::pair<long, long> tile_of(const Point2& p, double size_m) {
  return {std::lround(std::floor(p.x() / size_m)), std::lround(std::floor(p.y() / size_m))};
}

Point2 middle_of(const std::pair<long, long>& tile, double size_m) {
  return size_m * Point2(static_cast<double>(tile.first) + 0.5, static_cast<double>(tile.second) + 0.5);
}

/// At most `limit`, evenly chosen.
template <class T>
std::vector<T> evenly(const std::vector<T>& all, std::size_t limit) {
  if (all.size() <= limit) {
    return all;
  }
  std::vector<T> chosen;
  chosen.reserve(limit);
  for (std::size_t k = 0; k < limit; ++k) {
    chosen.push_back(all[k * all.size() / limit]);
  }
  return chosen;
}

std::vector<slam::SeenPoints> views_of(const Keyframes& keyframes, const PreparedMapParams& params) {
  std::vector<slam::SeenPoints> seen;
  for (const MapKeyframe* keyframe : evenly(keyframes, params.node_keyframes)) {
    slam::SeenPoints view = slam::transform(keyframe->node_T_base, slam::view_of(*keyframe, params.view_range_m));
    if (!view.points.empty()) {
      seen.push_back(std::move(view));
    }
  }
  return seen;
}

PreparedNode prepare(const MapNode& node, const Keyframes& keyframes, const PreparedMapParams& params) {
  PreparedNode made;
  made.id = node.id;
  made.keyframes = keyframes.size();
  made.seen = views_of(keyframes, params);
  const MapKeyframe* last = nullptr;
  for (const MapKeyframe* keyframe : keyframes) {
    made.middle += keyframe->node_T_base.translation() / static_cast<double>(keyframes.size());
    if (last == nullptr || distance_m(last->node_T_base, keyframe->node_T_base) >= params.signature.spacing_m) {
      made.signatures.push_back(signature_at(keyframe->node_T_base.translation(), made.seen, params.signature));
      last = keyframe;
    }
  }
  return made;
}

}  // namespace

PreparedMap::PreparedMap(const PreparedMapParams& params) : params_(params) {}

Status PreparedMap::update(LineMap map) {
  if (Status valid = validate(map); !valid) {
    return valid;
  }
  map_ = std::move(map);
  prepare_nodes();
  prepare_regions();
  prepare_graph();
  return {};
}

void PreparedMap::set_pictures(NodePictures pictures) {
  pictures_ = std::move(pictures);
  comparisons_.keep_only(pictures_);
}

void PreparedMap::prepare_nodes() {
  std::map<std::uint32_t, Keyframes> keyframes;
  for (const MapKeyframe& keyframe : map_.keyframes) {
    keyframes[keyframe.node].push_back(&keyframe);
  }
  std::map<std::uint32_t, PreparedNode> known;
  for (PreparedNode& node : nodes_) {
    known.emplace(node.id, std::move(node));
  }
  nodes_.clear();
  for (const MapNode& node : map_.nodes) {
    const Keyframes& own = keyframes[node.id];
    const auto old = known.find(node.id);
    PreparedNode made = old != known.end() && old->second.keyframes == own.size() ? std::move(old->second)
                                                                                  : prepare(node, own, params_);
    made.map_T_node = node.map_T_node;  // may have moved
    if (!made.seen.empty()) {
      nodes_.push_back(std::move(made));
    }
  }
}

void PreparedMap::prepare_regions() {
  const double size_m = tile_size_m(params_);
  region_of_tile_.clear();
  std::vector<std::pair<ScanSignature, std::size_t>> entries;
  regions_.clear();
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    PreparedNode& node = nodes_[k];
    const auto [it, fresh] =
        region_of_tile_.try_emplace(tile_of(node.map_T_node * node.middle, size_m), regions_.size());
    if (fresh) {
      regions_.push_back({.node = k, .members = {}, .place = nullptr});
    }
    node.region = it->second;
    for (const ScanSignature& signature : node.signatures) {
      entries.emplace_back(signature, k);
    }
  }
  index_ = SignatureIndex(std::move(entries));
  // A region sees the nodes of the tiles around its own, too.
  constexpr long kAround = 2;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto tile = tile_of(nodes_[k].map_T_node * nodes_[k].middle, size_m);
    for (long j = -kAround; j <= kAround; ++j) {
      for (long i = -kAround; i <= kAround; ++i) {
        const auto near = region_of_tile_.find({tile.first + i, tile.second + j});
        if (near != region_of_tile_.end()) {
          regions_[near->second].members.push_back(k);
        }
      }
    }
  }
}

void PreparedMap::prepare_graph() {
  constexpr double kKernelWidth = 3.0;
  graph_ = slam::PoseGraph();
  graph_node_.clear();
  // Without a graph nothing is known of the covariances: between() says so.
  if (Result<GraphNodes> added = add_map(graph_, map_, {}, variance_factor({&map_}), kKernelWidth)) {
    graph_node_ = *std::move(added);
  }
}

Result<PreparedMap> PreparedMap::deformed(const std::function<Pose2(std::uint32_t)>& map_T_node) const {
  PreparedMap made(params_);
  made.nodes_ = nodes_;
  made.made_ = made_;
  LineMap map = map_;
  for (MapNode& node : map.nodes) {
    node.map_T_node = map_T_node(node.id);
  }
  if (Status taken = made.update(std::move(map)); !taken) {
    return tl::unexpected<Error>(taken.error());
  }
  return made;
}

PreparedMap::Made PreparedMap::recipe_of(const PreparedRegion& region) const {
  Made made;
  const PreparedNode& own = nodes_[region.node];
  made.node = own.id;
  for (const std::size_t k : region.members) {
    made.members[nodes_[k].id] = {inverse(own.map_T_node) * nodes_[k].map_T_node, nodes_[k].keyframes};
  }
  return made;
}

bool PreparedMap::same(const Made& a, const Made& b) const {
  const auto near = [this](const auto& one, const auto& other) {
    const auto& [pose, keyframes] = one.second;
    const auto& [other_pose, other_keyframes] = other.second;
    return one.first == other.first && keyframes == other_keyframes &&
           distance_m(pose, other_pose) <= params_.moved_m &&
           std::abs(wrap_angle(pose.theta_rad - other_pose.theta_rad)) <= params_.moved_rad;
  };
  return a.node == b.node && a.members.size() == b.members.size() &&
         std::equal(a.members.begin(), a.members.end(), b.members.begin(), near);
}

std::shared_ptr<const slam::PlaceMap> PreparedMap::place(std::size_t region) {
  PreparedRegion& wanted = regions_.at(region);
  Made recipe = recipe_of(wanted);
  const auto known = std::find_if(made_.begin(), made_.end(), [&](const Made& made) { return same(made, recipe); });
  if (known != made_.end()) {
    std::rotate(made_.begin(), known, known + 1);
    return made_.front().place;
  }
  std::erase_if(made_, [&](const Made& made) { return made.node == recipe.node; });
  recipe.place = build(wanted);
  made_.insert(made_.begin(), std::move(recipe));
  if (made_.size() > params_.cached_regions) {
    made_.pop_back();
  }
  return made_.front().place;
}

std::shared_ptr<const slam::PlaceMap> PreparedMap::build(const PreparedRegion& region) const {
  const PreparedNode& own = nodes_[region.node];
  const double size_m = tile_size_m(params_);
  const Point2 middle = inverse(own.map_T_node) * middle_of(tile_of(own.map_T_node * own.middle, size_m), size_m);
  std::vector<slam::SeenPoints> seen;
  for (const std::size_t k : region.members) {
    const Pose2 own_T_node = inverse(own.map_T_node) * nodes_[k].map_T_node;
    for (const slam::SeenPoints& scan : nodes_[k].seen) {
      slam::SeenPoints placed = slam::transform(own_T_node, scan);
      if ((placed.origin - middle).norm() <= params_.region_view_m) {
        seen.push_back(std::move(placed));
      }
    }
  }
  Result<slam::PlaceMap> built = slam::PlaceMap::build(evenly(seen, params_.region_keyframes), params_.place);
  return built ? std::make_shared<const slam::PlaceMap>(*std::move(built)) : nullptr;
}

std::vector<std::size_t> PreparedMap::regions_like(const PreparedNode& other, std::size_t at_most) const {
  constexpr std::size_t kNeighbours = 8;  // of each signature
  constexpr double kNear = 0.05;          // a distance that is as good as none
  std::map<std::size_t, double> votes;
  for (std::size_t k = 0; k < regions_.size() && regions_.size() <= at_most; ++k) {
    votes[k] = 0.0;
  }
  for (const ScanSignature& signature : other.signatures) {
    for (const SignatureIndex::Found& found : index_.nearest(signature, kNeighbours)) {
      votes[nodes_[found.value].region] += 1.0 / (kNear + found.distance);
    }
  }
  std::vector<std::pair<double, std::size_t>> ranked;
  ranked.reserve(votes.size());
  for (const auto& [region, vote] : votes) {
    ranked.emplace_back(-vote, region);
  }
  std::sort(ranked.begin(), ranked.end());
  ranked.resize(std::min(ranked.size(), at_most));
  std::vector<std::size_t> regions(ranked.size());
  std::transform(ranked.begin(), ranked.end(), regions.begin(), [](const auto& entry) { return entry.second; });
  return regions;
}

std::optional<std::size_t> PreparedMap::region_at(const Point2& p_map) const {
  const double size_m = tile_size_m(params_);
  const auto own = tile_of(p_map, size_m);
  std::optional<std::size_t> best;
  double best_m = 1.5 * size_m;  // of a tile beside its own
  for (long j = -1; j <= 1; ++j) {
    for (long i = -1; i <= 1; ++i) {
      const auto near = region_of_tile_.find({own.first + i, own.second + j});
      const Point2 middle = middle_of({own.first + i, own.second + j}, size_m);
      if (near != region_of_tile_.end() && (middle - p_map).norm() < best_m) {
        best = near->second;
        best_m = (middle - p_map).norm();
      }
    }
  }
  return best;
}

UncertainPose PreparedMap::between(std::size_t from, std::size_t to) {
  constexpr double kUnknown_m2 = 100.0;
  const PreparedNode& a = nodes_.at(from);
  const PreparedNode& b = nodes_.at(to);
  if (from == to) {
    return {};
  }
  const Pose2 step = inverse(a.map_T_node) * b.map_T_node;
  if (graph_node_.empty()) {
    return {step, kUnknown_m2 * Matrix3::Identity()};
  }
  const Result<Matrix3> covariance = graph_.relative_covariance(graph_node_.at(a.id), graph_node_.at(b.id));
  return {step, covariance ? *covariance : kUnknown_m2 * Matrix3::Identity()};
}

std::map<std::uint32_t, std::size_t> node_indices(const PreparedMap& map) {
  std::map<std::uint32_t, std::size_t> indices;
  for (std::size_t k = 0; k < map.nodes().size(); ++k) {
    indices[map.nodes()[k].id] = k;
  }
  return indices;
}

}  // namespace seeker::fleet
