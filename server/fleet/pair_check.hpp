/// \file
/// Localisation of one robot's local map in a part of another's map: search, ICP, and the check of the points.
#pragma once

#include <functional>
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
  IcpParams icp;  ///< ICP from proposals of similar pictures, as printed (spec S4.6)
  /// Headings from which that ICP starts where the pictures say the rotation between the robots.
  std::vector<double> known_heading_restarts_rad{0.0, 0.2618, -0.2618};
  /// As min_consistency where similar pictures say the place: the far side of an object has no partner
  /// there, while eq (7) and the residual hold.
  double pictured_min_consistency = 0.5;
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

  /// Searches for a node of b in a region of a, at all positions and headings.
  [[nodiscard]] PairFindings find(PreparedMap& a, std::size_t region, const PreparedNode& node_b) const;
  /// The same from one place that similar pictures propose (spec S4.6): ICP with restarts, then the same checks.
  /// `map_a_T_node` is the proposed pose of the frame of node b in the frame `map` of a; the middle of node b is where
  /// its picture was taken.
  [[nodiscard]] PairFindings find_at(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                     const Pose2& map_a_T_node) const;
  /// As printed: ICP with restarts refines, eq (7) and the residual of ICP judge (spec S4.6, S4.7), and nothing else.
  [[nodiscard]] PairFindings find_as_printed(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                             const Pose2& map_a_T_node) const;

 private:
  struct Query;
  /// Why a pose that ICP has found is refused; empty where it is not, and the relation is filled then.
  using Judge = std::function<std::string_view(const Query& query, const IcpResult& found, NodeRelation& relation)>;
  [[nodiscard]] PairFindings find_by_icp(PreparedMap& a, std::size_t region, const PreparedNode& node_b,
                                         const Pose2& map_a_T_node, const IcpParams& params, const Judge& judge) const;
  void locate(PreparedMap& a, std::size_t region, const Query& query, const UncertainPose& region_T_base,
              NodeRelation& relation) const;
  [[nodiscard]] std::string_view examine(PreparedMap& a, std::size_t region, const Query& query, const Pose2& start,
                                         double min_consistency, NodeRelation& relation) const;

  PairCheckParams params_;
  slam::GlobalMatcher search_;
  slam::ScanMatcher matcher_;
};

}  // namespace seeker::fleet
