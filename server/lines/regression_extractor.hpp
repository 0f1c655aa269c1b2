/// \file
/// Line regression on a sliding window, as in the active-SLAM paper (spec S1.4 steps 1 and 2; Nguyen et al., IROS
/// 2005).
#pragma once

#include "server/lines/line.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

struct RegressionParams {
  NoiseParams noise;
  double bearing_sigma_rad = 0.0;  ///< standard deviation of the bearings of the beams; 0: they are exact
  double min_range_m = 0.1;        ///< nearer returns are left out
  double max_range_m = 0.0;        ///< farther returns are left out (6 m in the paper); 0: the scanner's own limit
  double max_gap_m = 0.15;         ///< largest gap between neighbouring points of one group
  double max_gap_spacings = 3.0;   ///< the same in spacings of beams at their range; the larger limit counts
  int max_missing_beams = 0;       ///< number of beams without return above which a new group begins
  int min_group = 6;               ///< groups of fewer points are left out
  int window_points = 9;           ///< N_f, number of points of a window; a smaller group is one window
  /// A run of windows ends where the fidelity m_i, the sum of the squared Mahalanobis distances between a window and
  /// its two neighbours, is not below this.
  double max_fidelity = 6.0;
  double merge_chi2 = 5.991;  ///< squared Mahalanobis distance below which adjacent runs are one line (2 dof, 95 %)
  double merge_gap_m = 0.2;   ///< largest gap between adjacent runs, or `max_gap_spacings` spacings if that is more
  /// Distance from the line, in standard deviations, above which a point is no inlier.
  double outlier_sigmas = 3.0;
  int min_points = 8;
  double min_length_m = 0.3;
};

class RegressionExtractor {
 public:
  explicit RegressionExtractor(const RegressionParams& params = {}) : params_(params) {}

  /// Extracts the lines of a scan that has passed validate().
  [[nodiscard]] ScanLines extract(const LaserScan& scan) const;

 private:
  RegressionParams params_;
};

}  // namespace seeker::lines
