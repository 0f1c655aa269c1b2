/// \file
/// Localisation of one robot's local map in a part of another's map: search, ICP, and the check of the points.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "server/fleet/icp.hpp"
#include "server/fleet/prepared_map.hpp"
#include "server/slam/global_matcher.hpp"
#include "server/slam/pairwise_consistency.hpp"
#include "server/slam/scan_matcher.hpp"

namespace seeker::fleet {

/// Relative pose of a local map of robot b and one of robot a.
struct NodeRelation {
  std::uint32_t node_a = 0;  ///< id of the local map of robot a
  std::uint32_t node_b = 0;  ///< id of the local map of robot b
  UncertainPose a_T_b;       ///< pose of the frame of node b in that of node a
  double overlap = 0.0;      ///< share of the points of b that lie where a has observed, 0 to 1
  double consistency = 0.0;  ///< share of these points that lie on surfaces of a
  double similarity = 0.0;   ///< spec S4.7, eq (7)
  double residual_m = 0.0;   ///< root mean square distance of the inliers
};

/// The inverse relation, with both robots swapped.
[[nodiscard]] NodeRelation reversed(const NodeRelation& relation);

struct PairCheckParams {
  slam::GlobalSearchParams search{.max_points = 200, .min_score = 0.3, .rival_ratio = 0.75, .max_candidates = 4};
  slam::MatchParams match;
  slam::AgreementParams agreement;
  std::size_t match_points = 500;
  std::size_t min_inliers = 80;   ///< number of inliers of the final match
  double min_overlap = 0.4;       ///< share of the node's points that lie where the region has been observed
  double min_consistency = 0.75;  ///< share of these points that lie on the region's surfaces
  double max_through = 0.12;      ///< share of beams through the region's walls
  double min_similarity = 0.6;    ///< spec S4.7 [J]
  double max_residual_m = 0.08;   ///< spec S4.7 [J]
  double similarity_sigma_m = 0.10;
  IcpParams icp;  ///< ICP from proposals of similar pictures
  /// Lower limit of the standard deviation of a match: local maps are distorted.
  double sigma_floor_m = 0.03;
  double sigma_floor_rad = 0.006;
};

/// Result of one comparison: the poses at which the node fits, or the cause why there is none.
struct PairFindings {
  std::vector<NodeRelation> relations;  ///< best first; several for a repeated or symmetric structure
  std::string_view refusal;
};

/// Compares local maps. Deterministic, without state but the parameters.
class PairCheck {
 public:
  explicit PairCheck(const PairCheckParams& params = {});

  /// Searches for a node of b in a region of a, at all positions and headings. `seen_from` is the node of a, by index,
  /// whose pictures are similar to those of node b: ICP starts from there, too (spec S4.6).
  [[nodiscard]] PairFindings find(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                  const std::optional<std::size_t>& seen_from = std::nullopt) const;

 private:
  struct Query;
  [[nodiscard]] std::string_view examine(PreparedMap& a, std::size_t region, const Query& query,
                                         const slam::GlobalCandidate& start, NodeRelation& relation) const;

  PairCheckParams params_;
  slam::GlobalMatcher search_;
  slam::ScanMatcher matcher_;
};

}  // namespace seeker::fleet
