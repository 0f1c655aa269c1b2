#include "server/fleet/merge_question.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::fleet {
namespace {

/// The part of a local map that was seen from around a picture, with its middle where that was taken.
PreparedNode surroundings_of(const PreparedNode& node, const NodePicture& picture, double radius_m) {
  PreparedNode part;
  part.id = node.id;
  part.map_T_node = node.map_T_node;
  part.region = node.region;
  part.middle = picture.node_T_base.translation();
  std::copy_if(node.seen.begin(), node.seen.end(), std::back_inserter(part.seen),
               [&](const slam::SeenPoints& scan) { return (scan.origin - part.middle).norm() <= radius_m; });
  part.keyframes = part.seen.size();
  return part;
}

/// Drops relations that say of two local maps what a better one says already: the same scans are one observation,
/// however often they are found.
void drop_repeated(std::vector<NodeRelation>& relations) {
  constexpr double kSame_m = 0.2;
  constexpr double kSame_rad = 0.05;
  std::vector<NodeRelation> kept;
  for (const NodeRelation& one : relations) {
    const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const NodeRelation& other) {
      return other.node_a == one.node_a && other.node_b == one.node_b &&
             distance_m(other.a_T_b.a_T_b, one.a_T_b.a_T_b) < kSame_m &&
             std::abs(wrap_angle(other.a_T_b.a_T_b.theta_rad - one.a_T_b.a_T_b.theta_rad)) < kSame_rad;
    });
    if (!repeated) {
      kept.push_back(one);
    }
  }
  relations = std::move(kept);
}

/// The worse of both directions.
void set_evidence(const MapOverlap& there, const MapOverlap& here, MergeHypothesis& made) {
  made.shared_wall_m = std::min(there.shared_wall_m, here.shared_wall_m);
  made.weak_wall_m = std::min(there.weak_wall_m, here.weak_wall_m);
  made.contradiction = std::max(there.contradiction, here.contradiction);
  made.denied_piece_m = std::max(there.denied_piece_m, here.denied_piece_m);
  made.residual_m = std::max(there.residual_m, here.residual_m);
  made.witnesses = std::min(there.witnesses, here.witnesses);
}

/// Whether one map denies more of the other than a certain merge allows.
bool is_denied(const MergeHypothesis& hypothesis, const MergeParams& params) {
  return hypothesis.contradiction > params.sure_contradiction ||
         hypothesis.denied_piece_m > allowed_piece_m(hypothesis, params);
}

/// The node of a map whose middle is nearest to a point of its frame.
std::uint32_t nearest_node(const PreparedMap& map, const Point2& p_map) {
  const auto nearest = std::min_element(map.nodes().begin(), map.nodes().end(), [&](const auto& p, const auto& q) {
    return (p.map_T_node * p.middle - p_map).norm() < (q.map_T_node * q.middle - p_map).norm();
  });
  return nearest->id;
}

/// Whether the deformation that the pairs of both demand is one that the maps allow, and the maps agree better for it.
bool may_join(const MergeHypothesis& best, const MergeHypothesis& other, const MergeHypothesis& both,
              const MergeParams& params) {
  const double added_chi2 = both.deformation.chi2 - best.deformation.chi2 - other.deformation.chi2;
  const auto added_dof = static_cast<double>(both.deformation.dof - best.deformation.dof - other.deformation.dof);
  const bool expected = added_chi2 <= params.consistency.gate_chi2 / 3.0 * added_dof;
  return (expected || other.pairs.size() >= params.deformation.min_pairs) &&
         both.deformation.ratio() <= params.deformation.max_ratio &&
         both.deformation.switched_off <= best.deformation.switched_off + other.deformation.switched_off &&
         both.contradiction <= std::max(best.contradiction, params.sure_contradiction) &&
         both.support() > best.support();
}

}  // namespace

void MergeQuestion::compare_scans(const PairCheck& check, MergeAnswer& answer) {
  for (const PreparedNode& node : b_.nodes()) {
    for (const std::size_t region : a_.regions_like(node, params_.regions_per_node)) {
      PairFindings found = check.find(a_, region, node);
      ++answer.compared;
      if (found.relations.empty()) {
        answer.rejected.push_back({a_.nodes()[a_.regions()[region].node].id, node.id, found.refusal});
      }
      relations_.insert(relations_.end(), found.relations.begin(), found.relations.end());
    }
  }
}

/// Whether a relation that was found says the same: the pair counts as evidence then and need not be checked.
bool MergeQuestion::is_known(const PicturePair& pair) const {
  return std::any_of(relations_.begin(), relations_.end(), [&](const NodeRelation& relation) {
    const Pose2 map_a_T_map_b = this->map_a_T_map_b(relation);
    return pictures_.agrees(pair, [&](std::size_t node) { return map_a_T_map_b * b_.nodes()[node].map_T_node; });
  });
}

void MergeQuestion::compare_pictures(const PairCheck& check, MergeAnswer& answer) {
  std::size_t checks = 0;
  for (const PicturePair& pair : pictures_.proposals()) {
    if (checks >= params_.pictures.max_checks || is_known(pair)) {
      continue;
    }
    const PreparedNode part = surroundings_of(b_.nodes()[pair.b.node], *pair.b.picture, params_.pictures.scans_m);
    PairFindings found =
        check.find_at(a_, region_of(a_, pair.a), part, pair.map_a_T_base_b() * inverse(pair.b.picture->node_T_base));
    ++answer.compared;
    ++checks;
    if (found.relations.empty()) {
      answer.rejected.push_back({a_.nodes()[pair.a.node].id, part.id, found.refusal, true});
    }
    relations_.insert(relations_.end(), found.relations.begin(), found.relations.end());
  }
}

void MergeQuestion::compare(const PairCheck& check, MergeAnswer& answer) {
  compare_scans(check, answer);
  compare_pictures(check, answer);
  // The best ones suffice; comparing all with all would cost the square of their number.
  const auto better = [](const NodeRelation& p, const NodeRelation& q) {
    return p.similarity * p.overlap > q.similarity * q.overlap;
  };
  std::stable_sort(relations_.begin(), relations_.end(), better);
  drop_repeated(relations_);
  relations_.resize(std::min(relations_.size(), params_.max_relations));
}

Pose2 MergeQuestion::map_a_T_map_b(const NodeRelation& pair) const {
  return node_a(pair).map_T_node * pair.a_T_b.a_T_b * inverse(node_b(pair).map_T_node);
}

std::vector<NodeRelation> MergeQuestion::largest_set(const std::vector<NodeRelation>& among) {
  const std::size_t first_b = a_.nodes().size();
  std::vector<slam::LoopEdge> edges;
  edges.reserve(among.size());
  for (const NodeRelation& pair : among) {
    edges.push_back({index_a_.at(pair.node_a), first_b + index_b_.at(pair.node_b), pair.a_T_b});
  }
  const auto odometry = [&](std::size_t from, std::size_t to) {
    if (from == to) {
      return UncertainPose{};
    }
    UncertainPose between = from < first_b ? a_.between(from, to) : b_.between(from - first_b, to - first_b);
    between.covariance = slam::with_floor(between.covariance, params_.distortion.sigma_m, params_.distortion.sigma_rad);
    return between;
  };
  std::vector<NodeRelation> members;
  for (const std::size_t k : slam::largest_consistent_set(edges, odometry, params_.consistency).members) {
    members.push_back(among[k]);
  }
  return members;
}

std::vector<PairPlace> MergeQuestion::places_of(const std::vector<NodeRelation>& pairs) const {
  std::vector<PairPlace> places;
  places.reserve(pairs.size());
  for (const NodeRelation& pair : pairs) {
    places.push_back(pair_place(pair.a_T_b, node_a(pair).map_T_node, node_b(pair).map_T_node));
  }
  return places;
}

MapOverlap MergeQuestion::overlap_by(const std::vector<PairPlace>& places, const Pose2& a_T_b) {
  const auto place_of = [&](std::size_t node) {
    return carried(places, a_T_b, b_.nodes()[node].map_T_node, params_.distortion);
  };
  return overlap_of(a_, b_, place_of, params_.overlap);
}

void MergeQuestion::compare_rigid(const std::vector<PairPlace>& places, MergeHypothesis& made) {
  const MapOverlap there = overlap_by(places, made.a_T_b.a_T_b);
  std::vector<NodeRelation> back;
  back.reserve(made.pairs.size());
  for (const NodeRelation& pair : made.pairs) {
    back.push_back(reversed(pair));
  }
  MergeQuestion other(b_, a_, pictures_, params_);  // for the walls alone
  set_evidence(there, other.overlap_by(other.places_of(back), inverse(made.a_T_b.a_T_b)), made);
}

std::optional<MergeHypothesis> MergeQuestion::deformed_hypothesis(std::vector<NodeRelation> pairs, const Pose2& a_T_b) {
  Result<DeformedPair> deformed = DeformedPair::make(a_.map(), b_.map(), pairs, a_T_b, params_.deformation);
  if (!deformed) {
    return std::nullopt;
  }
  Result<PreparedMap> deformed_a = a_.deformed([&](std::uint32_t id) { return deformed->pose_a(id); });
  Result<PreparedMap> deformed_b = b_.deformed([&](std::uint32_t id) { return deformed->pose_b(id); });
  if (!deformed_a || !deformed_b) {
    return std::nullopt;
  }
  const auto place_of_b = [&](std::size_t k) -> std::optional<Pose2> {
    const PreparedNode& node = deformed_b->nodes()[k];
    const std::uint32_t near = nearest_node(*deformed_a, node.map_T_node * node.middle);
    return deformed->certain(near, node.id) ? std::optional(node.map_T_node) : std::nullopt;
  };
  const auto place_of_a = [&](std::size_t k) -> std::optional<Pose2> {
    const PreparedNode& node = deformed_a->nodes()[k];
    const std::uint32_t near = nearest_node(*deformed_b, node.map_T_node * node.middle);
    return deformed->certain(node.id, near) ? std::optional(node.map_T_node) : std::nullopt;
  };
  MergeHypothesis made;
  set_evidence(overlap_of(*deformed_a, *deformed_b, place_of_b, params_.overlap),
               overlap_of(*deformed_b, *deformed_a, place_of_a, params_.overlap), made);
  made.deformation = deformed->deformation();
  std::vector<PairPlace> places = places_of(pairs);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    places[k].map_a_T_node.a_T_b = deformed->pose_b(pairs[k].node_b);
    if (deformed->in_force(k)) {
      made.pairs.push_back(pairs[k]);
    }
  }
  if (made.pairs.empty()) {
    made.pairs = std::move(pairs);
  }
  made.a_T_b = fuse(places, params_.distortion);
  complete(places, made);
  return made;
}

void MergeQuestion::complete(const std::vector<PairPlace>& places, MergeHypothesis& made) const {
  for (const NodeRelation& pair : made.pairs) {
    made.shared_middle_b += node_b(pair).map_T_node * node_b(pair).middle / static_cast<double>(made.pairs.size());
  }
  made.pictures = pictures_.evidence([&](std::size_t node) {
    return carried(places, made.a_T_b.a_T_b, b_.nodes()[node].map_T_node, params_.distortion);
  });
  made.confidence = confidence_of(made, params_);
}

MergeHypothesis MergeQuestion::rigid_hypothesis(std::vector<NodeRelation> pairs) {
  MergeHypothesis made;
  const std::vector<PairPlace> places = places_of(pairs);
  made.pairs = std::move(pairs);
  made.a_T_b = fuse(places, params_.distortion);
  compare_rigid(places, made);
  complete(places, made);
  return made;
}

MergeHypothesis MergeQuestion::hypothesis_of(std::vector<NodeRelation> pairs, const std::vector<NodeRelation>& among) {
  MergeHypothesis best = rigid_hypothesis(std::move(pairs));
  // Maps that agree as they are need no deformation, which could only make a wrong place look right.
  if (best.pairs.size() < params_.deformation.min_pairs || !is_denied(best, params_)) {
    return best;
  }
  // Rigid maps satisfy the pairs of one side of a bend only; those of the other side say nearly the same.
  const Pose2 a_T_b = best.a_T_b.a_T_b;
  const std::vector<NodeRelation> consistent = best.pairs;
  for (std::vector<NodeRelation> believed : {consistent, nearly_same(a_T_b, among)}) {
    std::optional<MergeHypothesis> deformed = deformed_hypothesis(std::move(believed), a_T_b);
    if (deformed && deformed->deformation.ratio() <= params_.deformation.max_ratio &&
        deformed->contradiction < best.contradiction) {
      best = *std::move(deformed);
    }
  }
  return best;
}

bool MergeQuestion::is_nearly_same(const Pose2& a_T_b, const NodeRelation& pair) const {
  constexpr double kSame_m = 1.0;
  constexpr double kSame_rad = 0.15;
  const Point2 middle = node_b(pair).map_T_node * node_b(pair).middle;
  const Pose2 own = map_a_T_map_b(pair);
  return (own * middle - a_T_b * middle).norm() < kSame_m &&
         std::abs(wrap_angle(own.theta_rad - a_T_b.theta_rad)) < kSame_rad;
}

std::vector<NodeRelation> MergeQuestion::nearly_same(const Pose2& a_T_b, const std::vector<NodeRelation>& among) const {
  std::vector<NodeRelation> same;
  std::copy_if(among.begin(), among.end(), std::back_inserter(same),
               [&](const NodeRelation& pair) { return is_nearly_same(a_T_b, pair); });
  return same;
}

void MergeQuestion::join_others(std::vector<MergeHypothesis>& made) {
  if (made.empty() || made.front().deformation.dof == 0) {
    return;
  }
  for (std::size_t k = 1; k < made.size();) {
    const MergeHypothesis& best = made.front();
    std::vector<NodeRelation> pairs = best.pairs;
    pairs.insert(pairs.end(), made[k].pairs.begin(), made[k].pairs.end());
    std::optional<MergeHypothesis> both = deformed_hypothesis(std::move(pairs), best.a_T_b.a_T_b);
    if (both && may_join(best, made[k], *both, params_)) {
      made.front() = *std::move(both);
      made.erase(made.begin() + static_cast<std::ptrdiff_t>(k));
    } else {
      ++k;
    }
  }
}

std::vector<MergeHypothesis> MergeQuestion::hypotheses() {
  std::vector<MergeHypothesis> made;
  std::vector<NodeRelation> open = relations_;
  while (!open.empty() && made.size() < params_.max_hypotheses) {
    made.push_back(hypothesis_of(largest_set(open), open));
    const std::vector<NodeRelation>& used = made.back().pairs;
    // What says nearly the same is no rival.
    std::erase_if(open, [&](const NodeRelation& pair) {
      return is_nearly_same(made.back().a_T_b.a_T_b, pair) ||
             std::any_of(used.begin(), used.end(), [&](const NodeRelation& other) {
               return other.a_T_b.a_T_b == pair.a_T_b.a_T_b && other.node_a == pair.node_a &&
                      other.node_b == pair.node_b;
             });
    });
  }
  // Where pictures show the same place they outweigh walls that are merely alike.
  std::stable_sort(made.begin(), made.end(), [&](const MergeHypothesis& p, const MergeHypothesis& q) {
    const auto rank = [&](const MergeHypothesis& one) {
      return std::pair(one.pictures.confirms(params_.pictures), one.support());
    };
    return rank(p) > rank(q);
  });
  join_others(made);
  return made;
}

}  // namespace seeker::fleet
