/// \file
/// Do two robots' maps show the same building, and how do they lie to each other? By their scans alone; pictures of
/// nodes propose too where robots have them (spec S4.5 to S4.7).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/fleet/map_overlap.hpp"
#include "server/fleet/pair_check.hpp"
#include "server/fleet/pair_fusion.hpp"
#include "server/fleet/prepared_map.hpp"
#include "server/slam/pairwise_consistency.hpp"

namespace seeker::fleet {

enum class MergeVerdict : std::uint8_t {
  kInsufficientOverlap,  ///< too little of one map is to be seen in the other: ask again when they have grown
  kAmbiguous,            ///< more than one way to lay them, or one that is not sure: ask the operator or drive on
  kContradicted,         ///< places look alike, but laid upon each other the maps deny it: probably another building
  kMerged,
};
[[nodiscard]] std::string_view to_string(MergeVerdict verdict);

/// A pair of local maps that was looked at and not believed (spec S4.7: feedback).
struct RejectedPair {
  std::uint32_t node_a = 0;
  std::uint32_t node_b = 0;
  std::string_view reason;
};

/// One way to lay map b upon map a, with what speaks for it.
struct MergeHypothesis {
  UncertainPose a_T_b;                      ///< pose of the frame `map` of robot b in that of robot a
  Point2 shared_middle_b = Point2::Zero();  ///< about where both have been, in the frame `map` of robot b
  std::vector<NodeRelation> pairs;  ///< local maps of both that show the same place, all consistent with each other
  double shared_wall_m = 0.0;       ///< length of wall that both have seen
  double weak_wall_m = 0.0;         ///< of it, what tells the place along the direction told worst
  double contradiction = 0.0;   ///< share of what both have looked at that one of them denies, 0 to 1; worse direction
  double denied_piece_m = 0.0;  ///< the longest piece of wall of one that the other has looked through
  double residual_m = 0.0;      ///< root mean square distance of the shared walls
  std::size_t witnesses = 0;    ///< local maps that show the walls of the other's map, of the robot that has fewer
  double confidence = 0.0;      ///< 0 to 1: grows with the shared wall, falls with the contradiction

  /// What hypotheses are ranked by.
  [[nodiscard]] double support() const { return shared_wall_m * (1.0 - 2.0 * contradiction); }
};

/// The verdict with its figures.
struct MergeAnswer {
  MergeVerdict verdict = MergeVerdict::kInsufficientOverlap;
  std::string reason;                       ///< one sentence
  std::vector<MergeHypothesis> hypotheses;  ///< best first; the first is the one to merge by
  std::vector<RejectedPair> rejected;       ///< in the order they were tried
  std::size_t compared = 0;                 ///< pairs

  [[nodiscard]] bool merged() const { return verdict == MergeVerdict::kMerged; }
  [[nodiscard]] double confidence() const { return hypotheses.empty() ? 0.0 : hypotheses.front().confidence; }
};

/// One set for every building and every laser.
struct MergeParams {
  PairCheckParams pair;
  vision::PlaceParams pictures;
  std::size_t regions_per_node = 4;  ///< of the other map, most alike first, that a node is compared with
  std::size_t max_relations = 64;    ///< the best ones between nodes, that are held against each other
  slam::ConsistencyParams consistency;
  OverlapParams overlap;
  BendParams bend;
  std::size_t max_hypotheses = 4;
  std::size_t min_pairs = 2;         ///< node pairs that must speak for a merge, or as many witnesses
  double min_shared_wall_m = 12.0;   ///< less is insufficient overlap
  double sure_shared_wall_m = 30.0;  ///< less is not certain
  double min_weak_wall_m = 4.0;      ///< of it, what tells the place along the direction told worst,
  double sure_weak_wall_m = 10.0;    ///< and again: two corridors of one building are alike but for their doors;
  double sure_weak_share = 0.25;     ///< as a share of the shared wall: long corridors have many doors
  double max_contradiction = 0.25;   ///< more is a contradiction
  double sure_contradiction = 0.18;  ///< more is not certain
  /// Noise denies walls here and there; where one has looked through a wall of the other this long, it is not certain.
  double sure_denied_piece_m = 1.5;
  /// The same for maps that are merged already: doors are shut and things are moved while robots drive.
  double kept_denied_piece_m = 3.0;
  /// Another hypothesis with this share of the best one's support, denied by no more than this, makes it ambiguous, if
  /// it has min_weak_wall_m.
  double rival_ratio = 0.35;
  double max_rival_contradiction = 0.4;
  double max_rival_denied_piece_m = 1.5;
};

[[nodiscard]] double confidence_of(const MergeHypothesis& hypothesis, const MergeParams& params);
/// Verdict and reason from the hypotheses, best first.
void judge(MergeAnswer& answer, const MergeParams& params);

/// Deterministic; no state but its parameters. Costs grow with n log n in the number of nodes (bench_merge).
class MapMerger {
 public:
  explicit MapMerger(const MergeParams& params = {});

  /// Prepared maps keep what is made ready of them for the next question; give each to one thread at a time.
  [[nodiscard]] MergeAnswer merge(PreparedMap& a, PreparedMap& b) const;
  [[nodiscard]] const MergeParams& params() const { return params_; }

 private:
  MergeParams params_;
  PairCheck check_;
};

}  // namespace seeker::fleet
