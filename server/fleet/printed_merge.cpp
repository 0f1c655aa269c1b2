#include <algorithm>
#include <utility>

#include "server/fleet/map_merger.hpp"

namespace seeker::fleet {
namespace {

/// The local map as it is matched: its middle is where the picture was taken, so that restarts of ICP rotate it there.
PreparedNode around_picture(const PreparedNode& node, const NodePicture& picture) {
  PreparedNode around = node;
  around.middle = picture.node_T_base.translation();
  return around;
}

/// The pair as a hypothesis. What both have seen of its walls is reported, but judges nothing.
MergeHypothesis hypothesis_of(PreparedMap& a, PreparedMap& b, const PicturePair& pictures, const NodeRelation& pair,
                              const MergeParams& params) {
  const auto node_a = std::find_if(a.nodes().begin(), a.nodes().end(),
                                   [&](const PreparedNode& node) { return node.id == pair.node_a; });
  const PreparedNode& node_b = b.nodes()[pictures.b.node];
  MergeHypothesis made;
  made.a_T_b = fuse({pair_place(pair.a_T_b, node_a->map_T_node, node_b.map_T_node)}, params.distortion);
  made.shared_middle_b = pictures.b.map_T_base.translation();
  made.pairs = {pair};
  const MapOverlap overlap = overlap_of(
      a, b, [&](std::size_t node) { return made.a_T_b.a_T_b * b.nodes()[node].map_T_node; }, params.overlap);
  made.shared_wall_m = overlap.shared_wall_m;
  made.weak_wall_m = overlap.weak_wall_m;
  made.contradiction = overlap.contradiction;
  made.denied_piece_m = overlap.denied_piece_m;
  made.residual_m = pair.residual_m;
  made.confidence = pair.similarity;
  return made;
}

}  // namespace

/// Spec S4.7: the pictures of b one after the other, for each the most similar ones of a. The heading that the pictures
/// say is not used: the pose of one robot is put on that of the other, and ICP starts again with other headings.
MergeAnswer MapMerger::merge_as_printed(PreparedMap& a, PreparedMap& b) const {
  MergeAnswer answer;
  answer.reason = "no picture of one robot shows a place of the other where their scans agree; drive on and ask again";
  const PicturePairs pictures(a, b, params_.pictures);
  for (const PicturePair& pair : pictures.proposals()) {
    const NodePicture& taken_b = *pair.b.picture;
    const PreparedNode node_b = around_picture(b.nodes()[pair.b.node], taken_b);
    const PairFindings found =
        check_.find_as_printed(a, region_of(a, pair.a), node_b, pair.a.map_T_base * inverse(taken_b.node_T_base));
    ++answer.compared;
    if (!found.relations.empty()) {
      answer.hypotheses = {hypothesis_of(a, b, pair, found.relations.front(), params_)};
      answer.verdict = MergeVerdict::kMerged;
      answer.reason = "a picture of one robot shows a place of the other, and their scans agree there";
      return answer;
    }
    answer.rejected.push_back({a.nodes()[pair.a.node].id, node_b.id, found.refusal, true});
  }
  return answer;
}

}  // namespace seeker::fleet
