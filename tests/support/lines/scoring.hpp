/// \file
/// Scores extracted lines against the walls they were seen on, after Nguyen et al. (IROS 2005).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "server/lines/line.hpp"
#include "tests/support/lines/rooms.hpp"

namespace seeker::testing {

struct ScoringParams {
  int min_points = 9;  ///< a run of beams on one wall that must be found
  double min_length_m = 0.5;
  int band_points = 1;       ///< runs so near to a limit need not be found, and may be found
  double band_length = 0.1;  ///< share of the limit
  double alpha_gate_rad = 0.1;
  double r_gate_m = 0.15;
  double beams_share = 0.5;  ///< of the run's beams that must belong to the line
};

/// A run of neighbouring beams on one wall.
struct WallRun {
  std::int32_t wall = 0;
  std::vector<std::size_t> beams;
  double length_m = 0.0;
  double r_m = 0.0;  ///< of the true wall, as a Line has them
  double alpha_rad = 0.0;
  bool required = false;
  bool allowed = false;
};
[[nodiscard]] std::vector<WallRun> wall_runs(const Room& room, const TrueScan& truth, const ScoringParams& params);

/// A line with the run it was found on.
struct LineMatch {
  std::size_t line = 0;
  std::size_t run = 0;
  double dr_m = 0.0;
  double dalpha_rad = 0.0;
  double nees = 0.0;  ///< 2 degrees of freedom; 0 for a covariance that cannot be inverted
};

/// Sums over scans.
struct LineScore {
  int required = 0;  ///< runs that had to be found
  int required_found = 0;
  int lines = 0;
  int false_lines = 0;  ///< on no allowed run
  int matches = 0;
  double dr2_m2 = 0.0;
  double dalpha2_rad2 = 0.0;
  double nees = 0.0;
  std::vector<double> nees_of_match;

  [[nodiscard]] double true_positive() const { return static_cast<double>(required_found) / std::max(required, 1); }
  [[nodiscard]] double false_positive() const { return static_cast<double>(false_lines) / std::max(lines, 1); }
  [[nodiscard]] double r_spread_m() const;
  [[nodiscard]] double alpha_spread_rad() const;
  [[nodiscard]] double nees_mean() const { return nees / std::max(matches, 1); }
};
void score_scan(const std::vector<WallRun>& runs, const lines::ScanLines& found, const ScoringParams& params,
                LineScore& score);

/// Unweighted total least squares on the true runs: what an extractor could at best do without knowing the noise.
[[nodiscard]] lines::ScanLines oracle_lines(const std::vector<WallRun>& runs, const TrueScan& truth);

}  // namespace seeker::testing
