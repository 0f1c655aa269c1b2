/// \file
/// Line detection with automatic thresholds, as the paper has it (spec S5.2-S5.6): five modes, thresholds that shrink
/// packet by packet until every line fits, merging by Mahalanobis distance.
#pragma once

#include <cstdint>
#include <vector>

#include "server/lines/line.hpp"
#include "server/lines/point_row.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

/// The two thresholds that set themselves.
struct LineThresholds {
  double gap_m = 0.150;   ///< Delta kappa_A: neighbours farther apart are in different packets
  double turn_m = 0.025;  ///< delta_line: a point farther from the line may be a turn
};

struct PaperParams {
  LineThresholds start;
  NoiseParams noise;
  double bearing_sigma_rad = 0.0;
  int seed_points = 5;             ///< n_seed
  int look_ahead = 2;              ///< points beyond the first one off the line that decide about a turn
  double max_fit_error_m = 0.005;  ///< E_kMax (spec S5.4)
  /// E_kMax and delta_line are never less than so many sigmas of the range noise, lest noise alone drive them down;
  /// 0 and 0: as printed, for a scanner as exact as the paper's.
  double fit_error_sigmas = 2.0;
  double turn_sigmas = 3.0;
  double shrink = 0.8;  ///< of both thresholds, per round
  int max_rounds = 8;
  double min_gap_spacings = 2.5;  ///< floor of the gap in spacings of beams at their range
  double min_turn_m = 0.002;
  int min_points = 6;
  double min_length_m = 0.1;
  double merge_distance = 3.03;  ///< delta_Mah of eq (12), the root of chi-square 9.21
  double merge_gap_m = 0.2;
};

/// How the thresholds of one packet set themselves.
struct PacketHistory {
  std::size_t first_beam = 0;  ///< counter-clockwise
  std::size_t last_beam = 0;
  std::vector<LineThresholds> rounds;  ///< tried one after the other
  std::vector<double> worst_error_m;   ///< largest E_l of each round
};

struct PaperLines {
  ScanLines found;
  std::vector<PacketHistory> history;
};

class PaperExtractor {
 public:
  explicit PaperExtractor(const PaperParams& params = {}) : params_(params) {}

  /// Lines of a scan that passed validate(), and how the thresholds came about.
  [[nodiscard]] PaperLines extract(const LaserScan& scan) const;
  [[nodiscard]] const PaperParams& params() const { return params_; }

 private:
  PaperParams params_;
};

}  // namespace seeker::lines
