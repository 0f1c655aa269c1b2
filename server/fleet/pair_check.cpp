#include "server/fleet/pair_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "server/slam/covariance.hpp"

namespace seeker::fleet {
namespace {

constexpr std::string_view kNothingSeen = "nothing was seen there";
constexpr std::string_view kNoPartners = "too few points find a partner";
constexpr std::string_view kOffTheWalls = "the points do not lie on the walls of the region";

/// Spec S4.7, eq (7), over the points that lie where the region has been observed.
double similarity_of(const slam::PlaceMap& place, const std::vector<slam::OrientedPoint>& points_base,
                     const Pose2& region_T_base, double sigma_m, double gate_m) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const slam::OrientedPoint& point : points_base) {
    const Point2 p = region_T_base * point.p;
    const slam::OrientedPoint* nearest = place.cloud().nearest(p, gate_m);
    if (nearest == nullptr && !place.free_space().is_free(p)) {
      continue;
    }
    ++count;
    sum += nearest == nullptr ? 0.0 : std::exp(-(nearest->p - p).squaredNorm() / (2.0 * sigma_m * sigma_m));
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

/// The node of a that stands nearest to a point of the region's frame.
std::size_t nearest_member(const PreparedMap& a, const PreparedRegion& region, const Point2& p_region) {
  const Pose2& map_T_region = a.nodes()[region.node].map_T_node;
  const Point2 p_map = map_T_region * p_region;
  std::size_t best = region.node;
  double best_m = std::numeric_limits<double>::infinity();
  for (const std::size_t k : region.members) {
    const PreparedNode& node = a.nodes()[k];
    const double away_m = (node.map_T_node * node.middle - p_map).norm();
    if (away_m < best_m) {
      best = k;
      best_m = away_m;
    }
  }
  return best;
}

}  // namespace

NodeRelation reversed(const NodeRelation& relation) {
  NodeRelation back = relation;
  std::swap(back.node_a, back.node_b);
  back.a_T_b = invert(relation.a_T_b);
  return back;
}

/// The node's scans with the origin at their centre, so that a rotation moves them little.
struct PairCheck::Query {
  Query(const PreparedNode& node_in, const PairCheckParams& params)
      : node(node_in), node_T_base{node_in.middle.x(), node_in.middle.y(), 0.0} {
    seen.reserve(node.seen.size());
    for (const slam::SeenPoints& scan : node.seen) {
      seen.push_back(slam::transform(inverse(node_T_base), scan));
      points.insert(points.end(), seen.back().points.begin(), seen.back().points.end());
    }
    sparse = slam::thin_by_cells(points, params.search.thin_cell_m, params.match_points);
  }

  const PreparedNode& node;
  Pose2 node_T_base;
  std::vector<slam::SeenPoints> seen;
  std::vector<slam::OrientedPoint> points;
  std::vector<slam::OrientedPoint> sparse;
};

PairCheck::PairCheck(const PairCheckParams& params) : params_(params), search_(params.search), matcher_(params.match) {}

PairFindings PairCheck::find(PreparedMap& a, std::size_t region, const PreparedNode& node_b) const {
  PairFindings findings;
  const std::shared_ptr<const slam::PlaceMap> place = a.place(region);
  if (!place) {
    findings.refusal = kNothingSeen;
    return findings;
  }
  const Query query(node_b, params_);
  findings.refusal = "no place of the region explains the points";
  for (const slam::GlobalCandidate& start : search_.search(place->pyramid(), query.points).candidates) {
    NodeRelation relation;
    const std::string_view refusal = examine(a, region, query, start.map_T_base, params_.min_consistency, relation);
    if (refusal.empty()) {
      findings.relations.push_back(relation);
    } else if (findings.relations.empty()) {
      findings.refusal = refusal;
    }
  }
  std::stable_sort(findings.relations.begin(), findings.relations.end(),
                   [](const NodeRelation& p, const NodeRelation& q) { return p.similarity > q.similarity; });
  findings.refusal = findings.relations.empty() ? findings.refusal : std::string_view();
  return findings;
}

PairFindings PairCheck::find_by_icp(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                    const Pose2& map_a_T_node, const IcpParams& params, const Judge& judge) const {
  PairFindings findings;
  const std::shared_ptr<const slam::PlaceMap> place = a.place(region);
  if (!place) {
    findings.refusal = kNothingSeen;
    return findings;
  }
  const Query query(node_b, params_);
  const Pose2& map_T_region = a.nodes()[a.regions()[region].node].map_T_node;
  const auto found =
      icp(place->cloud(), query.sparse, inverse(map_T_region) * map_a_T_node * query.node_T_base, params);
  NodeRelation relation;
  findings.refusal = found ? judge(query, *found, relation) : kNoPartners;
  if (findings.refusal.empty()) {
    findings.relations.push_back(relation);
  }
  return findings;
}

PairFindings PairCheck::find_at(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                const Pose2& map_a_T_node) const {
  IcpParams from_here = params_.icp;
  from_here.restarts_rad = params_.known_heading_restarts_rad;
  const auto judge = [&](const Query& query, const IcpResult& found, NodeRelation& relation) {
    return examine(a, region, query, found.a_T_b, params_.pictured_min_consistency, relation);
  };
  return find_by_icp(a, region, node_b, map_a_T_node, from_here, judge);
}

PairFindings PairCheck::find_as_printed(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                        const Pose2& map_a_T_node) const {
  const auto judge = [&](const Query& query, const IcpResult& found, NodeRelation& relation) {
    relation.overlap = found.pair_share;
    relation.consistency = found.pair_share;
    relation.similarity = similarity_of(*a.place(region), query.sparse, found.a_T_b, params_.similarity_sigma_m,
                                        params_.match.first_gate_m);
    relation.residual_m = std::sqrt(found.mean_square_m2);
    locate(a, region, query, {found.a_T_b, Matrix3::Zero()}, relation);
    const bool on_the_walls =
        relation.similarity >= params_.min_similarity && relation.residual_m <= params_.max_residual_m;
    return on_the_walls ? std::string_view() : kOffTheWalls;
  };
  return find_by_icp(a, region, node_b, map_a_T_node, params_.icp, judge);
}

void PairCheck::locate(PreparedMap& a, std::size_t region, const Query& query, const UncertainPose& region_T_base,
                       NodeRelation& relation) const {
  const Pose2& pose = region_T_base.a_T_b;
  const std::size_t node_a = nearest_member(a, a.regions()[region], pose.translation());
  const Pose2 a_T_region = inverse(a.nodes()[node_a].map_T_node) * a.nodes()[a.regions()[region].node].map_T_node;
  const Matrix3 turn = compose_jacobian_b(a_T_region, {});
  const Matrix3 covariance = turn * region_T_base.covariance * turn.transpose();
  relation.node_a = a.nodes()[node_a].id;
  relation.node_b = query.node.id;
  relation.a_T_b =
      compose({a_T_region * pose, slam::with_floor(covariance, params_.sigma_floor_m, params_.sigma_floor_rad)},
              {inverse(query.node_T_base), Matrix3::Zero()});
}

std::string_view PairCheck::examine(PreparedMap& a, std::size_t region, const Query& query, const Pose2& start,
                                    double min_consistency, NodeRelation& relation) const {
  const slam::PlaceMap& place = *a.place(region);
  const slam::MatchResult match = matcher_.match(place.cloud(), query.sparse, start);
  if (match.pairs < params_.match.min_pairs || match.inliers < static_cast<int>(params_.min_inliers)) {
    return kNoPartners;
  }
  const Pose2& pose = match.map_T_base;
  const slam::Agreement agreement =
      slam::agreement_of(place.pyramid(), place.free_space(), query.seen, pose, params_.agreement);
  const auto near = std::count_if(query.sparse.begin(), query.sparse.end(), [&](const slam::OrientedPoint& point) {
    return place.cloud().nearest(pose * point.p, params_.match.first_gate_m) != nullptr;
  });
  relation.overlap = static_cast<double>(near) / static_cast<double>(query.sparse.size()) + agreement.disagreement();
  relation.consistency = match.inlier_ratio / std::max(relation.overlap, match.inlier_ratio);
  relation.similarity =
      similarity_of(place, query.sparse, pose, params_.similarity_sigma_m, params_.match.first_gate_m);
  relation.residual_m = match.rms_m;
  locate(a, region, query, {pose, match.covariance}, relation);
  if (relation.overlap < params_.min_overlap) {
    return "too little of the node was seen in the region";
  }
  if (relation.consistency < min_consistency || relation.similarity < params_.min_similarity ||
      relation.residual_m > params_.max_residual_m) {
    return kOffTheWalls;
  }
  if (agreement.through > params_.max_through) {
    return "beams pass through walls of the region";
  }
  return {};
}

}  // namespace seeker::fleet
