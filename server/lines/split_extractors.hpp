/// \file
/// Two standard line extractors with fixed thresholds, for comparison: split-and-merge and iterative end-point fit
/// (Nguyen et al., IROS 2005).
#pragma once

#include "server/lines/line.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

struct SplitParams {
  NoiseParams noise;  ///< noise for the covariances only
  double bearing_sigma_rad = 0.0;
  double gap_m = 0.150;      ///< largest gap between neighbouring points of one group
  double split_m = 0.025;    ///< distance from the line above which a point splits it
  double merge_gap_m = 0.2;  ///< largest gap between the ends of two merged pieces
  int min_points = 6;
  double min_length_m = 0.1;
};

/// Splits at the point farthest from the fitted line; merges neighbours whose common fit keeps within the threshold.
class SplitAndMerge {
 public:
  explicit SplitAndMerge(const SplitParams& params = {}) : params_(params) {}
  [[nodiscard]] ScanLines extract(const LaserScan& scan) const;

 private:
  SplitParams params_;
};

/// Splits at the point farthest from the line through the first and the last point.
class Iepf {
 public:
  explicit Iepf(const SplitParams& params = {}) : params_(params) {}
  [[nodiscard]] ScanLines extract(const LaserScan& scan) const;

 private:
  SplitParams params_;
};

}  // namespace seeker::lines
