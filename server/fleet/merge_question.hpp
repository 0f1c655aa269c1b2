/// \file
/// One question of the merger: both maps, their similar pictures, and the relations found between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "server/fleet/map_merger.hpp"

namespace seeker::fleet {

/// Compares the maps of two robots once. The maps, pictures and parameters must outlive it.
class MergeQuestion {
 public:
  MergeQuestion(PreparedMap& a, PreparedMap& b, const PicturePairs& pictures, const MergeParams& params)
      : a_(a), b_(b), pictures_(pictures), params_(params), index_a_(node_indices(a)), index_b_(node_indices(b)) {}

  /// Finds relations between the maps by scans and pictures; counts comparisons and refusals in `answer`.
  void compare(const PairCheck& check, MergeAnswer& answer);
  /// Where the second map may stand in the first by the relations found, best first.
  [[nodiscard]] std::vector<MergeHypothesis> hypotheses();

 private:
  void compare_scans(const PairCheck& check, MergeAnswer& answer);
  void compare_pictures(const PairCheck& check, MergeAnswer& answer);
  [[nodiscard]] bool is_known(const PicturePair& pair) const;
  [[nodiscard]] Pose2 map_a_T_map_b(const NodeRelation& pair) const;
  [[nodiscard]] std::vector<NodeRelation> largest_set(const std::vector<NodeRelation>& among);
  /// The hypothesis that the pairs make, with both maps as they are where they agree, else deformed where that helps.
  /// `among` are the relations that no hypothesis has used yet.
  [[nodiscard]] MergeHypothesis hypothesis_of(std::vector<NodeRelation> pairs, const std::vector<NodeRelation>& among);
  /// Whether a relation lays the maps upon each other within a metre or so of `a_T_b`.
  [[nodiscard]] bool is_nearly_same(const Pose2& a_T_b, const NodeRelation& pair) const;
  [[nodiscard]] std::vector<NodeRelation> nearly_same(const Pose2& a_T_b, const std::vector<NodeRelation>& among) const;
  [[nodiscard]] MergeHypothesis rigid_hypothesis(std::vector<NodeRelation> pairs);
  /// The same with both maps deformed to satisfy the pairs; nothing where they cannot be joined. The deformation starts
  /// with map b at `a_T_b`.
  [[nodiscard]] std::optional<MergeHypothesis> deformed_hypothesis(std::vector<NodeRelation> pairs, const Pose2& a_T_b);
  void compare_rigid(const std::vector<PairPlace>& places, MergeHypothesis& made);
  /// Sets what follows from the walls' evidence and from the pictures.
  void complete(const std::vector<PairPlace>& places, MergeHypothesis& made) const;
  /// Joins others to the best hypothesis, which then differ from it only because a map is deformed between them.
  void join_others(std::vector<MergeHypothesis>& made);
  [[nodiscard]] std::vector<PairPlace> places_of(const std::vector<NodeRelation>& pairs) const;
  /// What the nodes of b find in a when the pairs are believed.
  [[nodiscard]] MapOverlap overlap_by(const std::vector<PairPlace>& places, const Pose2& a_T_b);
  [[nodiscard]] const PreparedNode& node_a(const NodeRelation& pair) const {
    return a_.nodes()[index_a_.at(pair.node_a)];
  }
  [[nodiscard]] const PreparedNode& node_b(const NodeRelation& pair) const {
    return b_.nodes()[index_b_.at(pair.node_b)];
  }

  PreparedMap& a_;
  PreparedMap& b_;
  const PicturePairs& pictures_;
  const MergeParams& params_;
  std::map<std::uint32_t, std::size_t> index_a_;
  std::map<std::uint32_t, std::size_t> index_b_;
  std::vector<NodeRelation> relations_;
};

}  // namespace seeker::fleet
