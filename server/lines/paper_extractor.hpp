/// \file
/// Line detection with automatic thresholds as in the paper (spec S5.2-S5.6): five modes, thresholds that shrink packet
/// by packet until every line fits, and merging by Mahalanobis distance.
#pragma once

#include "server/lines/line.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

struct PaperParams {
  LineThresholds start;
  NoiseParams noise;
  double bearing_sigma_rad = 0.0;
  int seed_points = 5;             ///< n_seed
  int look_ahead = 2;              ///< number of points beyond the first one off the line that decide about a corner
  double max_fit_error_m = 0.005;  ///< E_kMax (spec S5.4)
  /// Lower limits of E_kMax and delta_line in standard deviations of the range noise, so that noise alone does not
  /// reduce them; 0 and 0 as printed, for a scanner as exact as the paper's.
  double fit_error_sigmas = 2.0;
  double corner_sigmas = 3.0;
  double shrink = 0.8;  ///< factor of both thresholds per round
  int max_rounds = 8;
  double min_gap_spacings = 2.5;  ///< lower limit of the gap in spacings of beams at their range
  double min_corner_m = 0.002;
  int min_points = 6;
  double min_length_m = 0.1;
  double merge_distance = 3.03;  ///< delta_Mah of eq (12), the root of chi-square 9.21
  double merge_gap_m = 0.2;
};

class PaperExtractor {
 public:
  explicit PaperExtractor(const PaperParams& params = {}) : params_(params) {}

  /// Extracts the lines of a scan that has passed validate(), with the history of the thresholds.
  [[nodiscard]] ScanLines extract(const LaserScan& scan) const;
  [[nodiscard]] const PaperParams& params() const { return params_; }

 private:
  PaperParams params_;
};

}  // namespace seeker::lines
