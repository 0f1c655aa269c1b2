/// \file
/// Loop closure between local maps: candidates are searched where the robot may be, refined, and rejected when the
/// scans contradict them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "server/slam/pairwise_consistency.hpp"
#include "server/slam/place_recogniser.hpp"

namespace seeker::slam {

/// A finished local map of the database, prepared with PlaceMap::build() from its scans in its own frame, and what the
/// graph believes of the query in that frame (PoseGraph::relative_covariance).
struct LoopTarget {
  std::size_t id = 0;  ///< identifier chosen by the caller and returned with the loop
  std::shared_ptr<const PlaceMap> place;
  UncertainPose target_T_query;
};

struct LoopParams {
  GlobalSearchParams search{.max_points = 160, .min_score = 0.2, .rival_ratio = 0.75, .max_candidates = 4};
  MatchParams match;
  AgreementParams agreement;
  double window_sigmas = 3.0;  ///< half width of the search window, in standard deviations
  double min_window_m = 1.0;   ///< lower limit of the half width
  double max_window_m = 6.0;   ///< upper limit of the half width
  /// Half width in which no other place may fit as well, however certain the graph is: it may be wrong about that, and
  /// rooms repeat themselves every few metres.
  double rival_window_m = 4.0;
  double min_window_rad = 0.15;
  double max_window_rad = 0.8;
  std::size_t match_points = 400;
  std::size_t min_inliers = 60;  ///< number of inliers of the final match
  /// Share of the query's points that lie where the target has observed surfaces or free space.
  double min_overlap = 0.25;
  double min_consistency = 0.75;  ///< share of these points that lie on the target's surfaces
  /// A loop is rejected as ambiguous when another place has this share of its consistency.
  double rival_consistency = 0.9;
  /// Lower limit of the standard deviation of a match: local maps are distorted.
  double sigma_floor_m = 0.02;
  double sigma_floor_rad = 0.004;
};

/// A loop that the points confirm. Several of them should still be checked against each other (largest_consistent_set)
/// and be switchable edges of the graph.
struct VerifiedLoop {
  std::size_t id = 0;            ///< identifier of the target
  UncertainPose target_T_query;  ///< the covariance is very large along a direction that the scans do not constrain
  Matrix3 information = Matrix3::Zero();  ///< inverse of the covariance: almost zero along that direction
  double score = 0.0;                     ///< score of the search, 0 to 1
  double overlap = 0.0;
  double consistency = 0.0;
  Agreement agreement;
  std::optional<Point2> degenerate_direction;  ///< unit vector in the frame of the target
};

/// Finds and verifies loops. Deterministic, without state but the parameters.
class LoopDetector {
 public:
  explicit LoopDetector(const LoopParams& params = {});

  /// The loops of the query (its scans in its own frame) with any of the targets, most consistent first.
  [[nodiscard]] std::vector<VerifiedLoop> detect(const std::vector<SeenPoints>& seen_query,
                                                 const std::vector<LoopTarget>& targets) const;
  /// The loop with one target; no value when no pose or more than one fits.
  [[nodiscard]] std::optional<VerifiedLoop> verify(const std::vector<SeenPoints>& seen_query,
                                                   const LoopTarget& target) const;
  [[nodiscard]] const LoopParams& params() const { return params_; }

 private:
  struct Query;
  [[nodiscard]] SearchWindow window_of(const UncertainPose& target_T_query) const;
  [[nodiscard]] std::optional<VerifiedLoop> examine(const Query& query, const LoopTarget& target,
                                                    const GlobalCandidate& start) const;
  [[nodiscard]] std::vector<VerifiedLoop> fitting(const Query& query, const LoopTarget& target,
                                                  const std::vector<GlobalCandidate>& starts) const;
  [[nodiscard]] bool has_rival(const VerifiedLoop& best, const std::vector<VerifiedLoop>& loops) const;

  LoopParams params_;
  GlobalMatcher search_;
  ScanMatcher matcher_;
};

}  // namespace seeker::slam
