/// \file
/// Global scan matching: finds all poses at which points fit a map, by branch and bound over the map or a window.
#pragma once

#include <optional>
#include <vector>

#include "server/slam/likelihood_pyramid.hpp"

namespace seeker::slam {

struct GlobalSearchParams {
  std::size_t max_points = 120;  ///< number of points that are compared, at most 250
  /// Grid in which one point per cell and normal is kept: near walls do not outweigh far ones.
  double thin_cell_m = 0.15;
  int leaf_level = 1;              ///< candidates are blocks of 2^level cells, a resolution from which ICP converges
  double min_step_rad = 0.0145;    ///< smallest heading step; the step moves far points by one leaf cell
  double max_step_rad = 0.035;     ///< largest heading step
  double far_quantile = 0.8;       ///< quantile of the point ranges that sets the heading step
  double min_score = 0.35;         ///< candidates with a lower score are discarded
  double rival_ratio = 0.7;        ///< candidates below this share of the best score are not searched for
  std::size_t max_candidates = 6;  ///< largest number of returned candidates
  double distinct_m = 0.5;         ///< candidates closer than this in position
  double distinct_rad = 0.35;      ///< and closer than this in heading count as one
  std::size_t max_expansions = 4'000'000;  ///< limit of scored blocks, beyond which the search ends incomplete
};

/// Centre of a search and its half widths in x, y and heading.
struct SearchWindow {
  Pose2 map_T_base;
  double half_m = 4.0;
  double half_rad = 0.5;
};

struct GlobalCandidate {
  Pose2 map_T_base;    ///< accurate to about half a leaf and half a heading step; refine it with ScanMatcher
  double score = 0.0;  ///< mean likelihood of the points, 0 to 1
};

struct GlobalSearchResult {
  std::vector<GlobalCandidate> candidates;  ///< distinct from each other, best first
  std::size_t points = 0;                   ///< number of points that were compared
  std::size_t expansions = 0;               ///< number of blocks that were scored
  bool complete = true;                     ///< false when cut at max_expansions, so that a better pose may exist
};

/// Depth-first branch and bound with the blocks of the top level in best-first order (Hess et al., ICRA 2016). The sum
/// of a level's maxima bounds the score of a block from above, so that the best candidate is the best pose of the
/// lattice. The result is deterministic and depends on no state but the parameters.
class GlobalMatcher {
 public:
  explicit GlobalMatcher(const GlobalSearchParams& params = {}) : params_(params) {}

  /// Searches for points in the frame `base`, of one scan or of several combined by odometry. Without a window the base
  /// may be anywhere within the map, with any heading. An empty set of points gives no candidate.
  [[nodiscard]] GlobalSearchResult search(const LikelihoodPyramid& map, const std::vector<OrientedPoint>& points_base,
                                          const std::optional<SearchWindow>& window = std::nullopt) const;
  [[nodiscard]] const GlobalSearchParams& params() const { return params_; }

 private:
  GlobalSearchParams params_;
};

/// Keeps one point per cell and direction of the normal, at most `limit` of them, evenly chosen. Deterministic.
[[nodiscard]] std::vector<OrientedPoint> thin_by_cells(const std::vector<OrientedPoint>& points, double cell_m,
                                                       std::size_t limit);

}  // namespace seeker::slam
