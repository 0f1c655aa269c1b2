/// \file
/// Where in a map do these points fit, and where else? Branch and bound over all poses or those of a window.
#pragma once

#include <optional>
#include <vector>

#include "server/slam/likelihood_pyramid.hpp"

namespace seeker::slam {

struct GlobalSearchParams {
  std::size_t max_points = 120;  ///< points compared, at most 250
  double thin_cell_m = 0.15;     ///< of points with like normals one is kept a cell: near walls do not outvote far ones
  int leaf_level = 1;            ///< candidates are blocks of 2^level cells: what an ICP afterwards makes good
  double min_step_rad = 0.0145;  ///< headings are tried at steps that move far points by a leaf, within these limits
  double max_step_rad = 0.035;
  double far_quantile = 0.8;  ///< this share of the points is nearer than those that set the step
  double min_score = 0.35;    ///< candidates below it are none
  double rival_ratio = 0.7;   ///< candidates below this share of the best score are not looked for
  std::size_t max_candidates = 6;
  double distinct_m = 0.5;                 ///< candidates nearer than this in place
  double distinct_rad = 0.35;              ///< and heading are one
  std::size_t max_expansions = 4'000'000;  ///< scored blocks; beyond it the search ends and says so
};

/// Centre and half widths in x, y and heading.
struct SearchWindow {
  Pose2 map_T_base;
  double half_m = 4.0;
  double half_rad = 0.5;
};

struct GlobalCandidate {
  Pose2 map_T_base;    ///< to about half a leaf and half a step of heading: refine it with ScanMatcher
  double score = 0.0;  ///< mean likelihood of the points, 0 to 1
};

struct GlobalSearchResult {
  std::vector<GlobalCandidate> candidates;  ///< distinct from each other, best first
  std::size_t points = 0;                   ///< that were compared
  std::size_t expansions = 0;
  bool complete = true;  ///< false: cut at max_expansions, so that a better pose may exist
};

/// Depth-first branch and bound with the blocks of the top level in best-first order (Hess et al., ICRA 2016). The sum
/// of a level's maxima bounds the score of a block from above, so that the best candidate is the best pose of the
/// lattice. Deterministic; no state but its parameters.
class GlobalMatcher {
 public:
  explicit GlobalMatcher(const GlobalSearchParams& params = {}) : params_(params) {}

  /// Points in the frame `base`: of one scan, or of several put together by odometry. Without a window the base may be
  /// anywhere within the map, with any heading. No points give no candidate.
  [[nodiscard]] GlobalSearchResult search(const LikelihoodPyramid& map, const std::vector<OrientedPoint>& points_base,
                                          const std::optional<SearchWindow>& window = std::nullopt) const;
  [[nodiscard]] const GlobalSearchParams& params() const { return params_; }

 private:
  GlobalSearchParams params_;
};

/// One point a cell and direction of its normal, at most `limit` of them, evenly chosen. Deterministic.
[[nodiscard]] std::vector<OrientedPoint> thin_by_cells(const std::vector<OrientedPoint>& points, double cell_m,
                                                       std::size_t limit);

}  // namespace seeker::slam
