/// \file
/// Map merging: decides whether two robots' maps show the same building, and estimates their relative pose, from their
/// scans, and from the pictures of their topologies' nodes where they have taken any (spec S4.5 to S4.7).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/fleet/deformed_pair.hpp"
#include "server/fleet/map_overlap.hpp"
#include "server/fleet/pair_check.hpp"
#include "server/fleet/pair_fusion.hpp"
#include "server/fleet/picture_pairs.hpp"
#include "server/fleet/prepared_map.hpp"
#include "server/slam/pairwise_consistency.hpp"

namespace seeker::fleet {

enum class MergeVerdict : std::uint8_t {
  kInsufficientOverlap,  ///< the maps have too little in common: try again when they have grown
  kAmbiguous,            ///< several relative poses, or an uncertain one: ask the operator or drive on
  kContradicted,         ///< places are similar, but the aligned maps contradict each other: probably another building
  kMerged,
};
[[nodiscard]] std::string_view to_string(MergeVerdict verdict);

/// How two maps are compared.
enum class MergeMethod : std::uint8_t {
  kPicturesAndLaser,  ///< scans and pictures propose, the whole maps judge; without pictures scans alone
  kPrinted,           ///< spec S4.7: pictures propose, ICP refines, eq (7) of one pair judges
};
[[nodiscard]] std::string_view to_string(MergeMethod method);

/// A pair of local maps that was compared and rejected (spec S4.7: feedback).
struct RejectedPair {
  std::uint32_t node_a = 0;
  std::uint32_t node_b = 0;
  std::string_view reason;
  bool by_pictures = false;  ///< similar pictures had proposed it
};

/// A hypothesis of the relative pose of two maps with its evidence.
struct MergeHypothesis {
  UncertainPose a_T_b;  ///< pose of the frame `map` of robot b in that of robot a
  /// Approximate centre of the area that both have observed, in the frame `map` of robot b.
  Point2 shared_middle_b = Point2::Zero();
  std::vector<NodeRelation> pairs;  ///< local maps of both that show the same place, all consistent with each other
  double shared_wall_m = 0.0;       ///< length of wall that both have observed
  double weak_wall_m = 0.0;         ///< part of it that constrains the least constrained direction
  /// Share of the area observed by both that one of them contradicts, 0 to 1; the worse direction.
  double contradiction = 0.0;
  double denied_piece_m = 0.0;  ///< longest piece of wall of one map that the other has looked through
  double residual_m = 0.0;      ///< root mean square distance of the shared walls
  /// Number of local maps that show the walls of the other's map, of the robot that has fewer.
  std::size_t witnesses = 0;
  PictureEvidence pictures;  ///< what the pictures of both robots say of it
  Deformation deformation;   ///< how far both maps were deformed before they were compared
  double confidence = 0.0;   ///< 0 to 1: grows with the shared wall, falls with the contradiction

  /// The criterion by which hypotheses are ranked.
  [[nodiscard]] double support() const { return shared_wall_m * (1.0 - 2.0 * contradiction); }
};

/// The verdict with its evidence.
struct MergeAnswer {
  MergeVerdict verdict = MergeVerdict::kInsufficientOverlap;
  std::string reason;                       ///< one sentence
  std::vector<MergeHypothesis> hypotheses;  ///< best first; the first is used for the merge
  std::vector<RejectedPair> rejected;       ///< in the order of the comparisons
  std::size_t compared = 0;                 ///< number of pairs

  [[nodiscard]] bool merged() const { return verdict == MergeVerdict::kMerged; }
  [[nodiscard]] double confidence() const { return hypotheses.empty() ? 0.0 : hypotheses.front().confidence; }
};

/// Parameters for all buildings and lasers.
struct MergeParams {
  MergeMethod method = MergeMethod::kPicturesAndLaser;
  PairCheckParams pair;
  PictureParams pictures;
  /// Number of regions of the other map, most similar first, with which a node is compared.
  std::size_t regions_per_node = 4;
  std::size_t max_relations = 64;  ///< number of best relations between nodes that are checked against each other
  slam::ConsistencyParams consistency;
  OverlapParams overlap;
  DistortionParams distortion;
  DeformationParams deformation;
  std::size_t max_hypotheses = 4;
  std::size_t min_pairs = 2;        ///< number of node pairs required for a merge, or of witnesses
  double min_shared_wall_m = 12.0;  ///< shared wall below which the overlap is insufficient
  /// The same where pictures confirm the place: the operator may then decide.
  double pictured_shared_wall_m = 3.0;
  double sure_shared_wall_m = 30.0;  ///< shared wall below which the merge is not certain
  double min_weak_wall_m = 4.0;      ///< part of it that must constrain the least constrained direction
  /// The same for a certain merge: two corridors of one building differ only by their doors.
  double sure_weak_wall_m = 10.0;
  double sure_weak_share = 0.25;     ///< the same as a share of the shared wall: long corridors have many doors
  double max_contradiction = 0.25;   ///< contradiction above which the maps are of different places
  double sure_contradiction = 0.18;  ///< contradiction above which the merge is not certain
  /// Length of a wall of one map that the other has looked through above which the merge is not certain; shorter pieces
  /// occur by noise.
  double sure_denied_piece_m = 1.5;
  /// The same as a share of the shared wall, up to kept_denied_piece_m: doors, chairs and people move in many places.
  double denied_piece_share = 0.01;
  /// The same for maps that are merged already: doors are shut and objects are moved while robots drive.
  double kept_denied_piece_m = 3.0;
  /// The result is ambiguous when another hypothesis has this share of the best one's support, at most the
  /// contradiction below, and min_weak_wall_m.
  double rival_ratio = 0.35;
  double max_rival_contradiction = 0.4;
  double max_rival_denied_piece_m = 2.0;
};

/// Length of a wall of one map that the other may have looked through in a certain merge: the more both have seen, the
/// longer is the longest piece that was moved in the meantime.
[[nodiscard]] double allowed_piece_m(const MergeHypothesis& best, const MergeParams& params);
[[nodiscard]] double confidence_of(const MergeHypothesis& hypothesis, const MergeParams& params);
/// Sets verdict and reason by the hypotheses, best first.
void judge(MergeAnswer& answer, const MergeParams& params);

/// Deterministic, without state but the parameters. The cost grows with n log n in the number of nodes (bench_merge).
class MapMerger {
 public:
  explicit MapMerger(const MergeParams& params = {});

  /// Merges two maps. Prepared maps keep the data prepared for the comparison; each may be used by one thread at a
  /// time.
  [[nodiscard]] MergeAnswer merge(PreparedMap& a, PreparedMap& b) const;
  [[nodiscard]] const MergeParams& params() const { return params_; }

 private:
  [[nodiscard]] MergeAnswer merge_as_printed(PreparedMap& a, PreparedMap& b) const;

  MergeParams params_;
  PairCheck check_;
};

}  // namespace seeker::fleet
