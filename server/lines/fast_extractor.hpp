/// \file
/// Line extraction in O(n): running sums, iterative split and merge, with range noise estimated from the scan (spec S5;
/// S1.4 steps 1-2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/lines/extractor.hpp"
#include "server/lines/line.hpp"
#include "server/lines/line_fit.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

struct FastParams {
  NoiseParams noise;
  double bearing_sigma_rad = 0.0;  ///< standard deviation of the bearings of the beams; 0: they are exact
  double straightness_m = 0.0;     ///< deviation of a wall from a straight line, in addition to the noise
  double max_gap_m = 0.15;         ///< largest gap between neighbouring points of one group, unless they are in line
  double max_gap_spacings = 3.0;   ///< the same in spacings of beams at their range (spec S1.4 step 1)
  double in_line_sigmas = 4.0;     ///< distance from a neighbour's line up to which a gap does not begin a new group
  int max_missing_beams = 2;       ///< number of beams without return above which a new group begins
  double split_sigmas = 4.0;       ///< distance from the line above which a point splits it
  /// Excess of the mean square over the noise, in standard deviations, above which a line is split.
  double excess_sigmas = 4.0;
  double merge_sigmas = 5.0;     ///< distance from a common line up to which two pieces are merged
  double split_chi2 = 16.0;      ///< chi-square by which two lines must explain the parts of a piece better than one
  double max_merge_gap_m = 0.2;  ///< largest gap between the ends of two merged pieces (spec S5.6)
  /// Distance to the next wall's line below which noise decides to which of the two a point belongs.
  double corner_sigmas = 3.0;
  double corner_doubt = 1.0;  ///< additional variance of such a point, in units of its noise
  /// Excess of the mean square over the noise above which the covariance is increased.
  double inflation_sigmas = 2.0;
  int max_outliers = 3;  ///< number of points between two pieces of one line that may be left out
  int min_points = 8;    ///< smallest number of points of a line (spec S1.4 step 2d)
  double min_length_m = 0.3;
  double min_range_m = 0.05;  ///< nearer returns are ignored, even where the scanner's own limit is lower
  double max_range_m = 0.0;   ///< farther returns are ignored; 0: the scanner's own limit
};

/// Keeps its buffers and the sines of the scanner's beams, so that each scanner needs its own. The result depends on
/// the scan alone.
class FastExtractor final : public Extractor {
 public:
  explicit FastExtractor(const FastParams& params = {}) : params_(params) {}

  void extract(const LaserScan& scan, ScanLines& found) override;
  using Extractor::extract;

  [[nodiscard]] const FastParams& params() const { return params_; }
  /// Range noise of the most recently extracted scan.
  [[nodiscard]] const RangeNoise& noise() const { return noise_; }

 private:
  /// Lower limit of the cosine between beam and normal: at grazing incidence beams do not locate the wall better.
  static constexpr double kMinCosine = 0.05;
  /// Splitting ends at pieces with fewer points: any three are nearly a line.
  static constexpr int kMinPiece = 4;

  /// The returns first..last (inclusive); excluded returns among them are not in `sums`.
  struct Piece {
    int first = 0;
    int last = 0;
    int points = 0;
    Moments sums;
    double across_m2 = 0.0;  ///< LineFit::across_m2
    LineFit fit;             ///< of pieces that are lines; fragments have none
    int doubtful_first = 0;  ///< number of returns at the begin that may belong to the previous wall
    int doubtful_last = 0;   ///< number of returns at the end that may belong to the next wall
  };

  /// Scatter of the points about a line: their mean square in units of the expected noise.
  struct Scatter {
    double dof = 0.0;
    double excess = 0.0;
  };

  [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void use_geometry(const LaserScan& scan);
  void load(const LaserScan& scan);
  /// load() of a scan whose beams all returned; false for others.
  [[nodiscard]] bool load_all(const LaserScan& scan, float low, float high);
  void open_circle();
  [[nodiscard]] int widest_gap(int count) const;
  [[nodiscard]] bool breaks_before(int i) const;
  void sum_up();
  void split_groups();
  void split(int first, int last);
  [[nodiscard]] bool is_line(const Piece& whole) const;
  [[nodiscard]] bool is_near(const LineFit& fit, int first, int last, double sigmas) const;
  [[nodiscard]] double mean_variance(const LineFit& fit, int first, int last) const;
  [[nodiscard]] bool is_one_line(double across_m2, double parts_m2, double w, double points, double variance_m2) const;
  [[nodiscard]] int farthest_from_chord(int first, int last) const;
  [[nodiscard]] Point2 point(int i) const;
  [[nodiscard]] Piece piece(int first, int last) const;
  void merge_pieces();
  [[nodiscard]] bool absorb(Piece& piece, const Piece& next);
  void settle_corners();
  [[nodiscard]] bool meet_in_corner(const Piece& a, const Piece& b) const;
  bool settle_corner(Piece& a, Piece& b);
  void move_corner(Piece& from, Piece& to, int i);
  void doubt_corners();
  [[nodiscard]] int doubtful_at_corner(const Piece& piece, const LineFit& other, bool at_end) const;
  [[nodiscard]] double cosine_of(const LineFit& fit, int i) const;
  [[nodiscard]] double range_residual2(const LineFit& fit, int i) const;
  [[nodiscard]] NoiseSums noise_of(const Piece& piece);
  void finish(const LaserScan& scan, const Piece& piece, Line& line);
  void mark_beams(const Piece& piece, std::int32_t line, ScanLines& found) const;
  void write(const LaserScan& scan, ScanLines& found);
  [[nodiscard]] double noise_factor() const;
  void settle_noise(ScanLines& found);
  [[nodiscard]] std::size_t rank_in_circle(int i) const;
  [[nodiscard]] std::size_t beam_of(int i) const;

  FastParams params_;
  RangeNoise noise_;
  NoiseEstimator estimator_;
  // The scanner's geometry, counter-clockwise.
  std::size_t beams_ = 0;
  double first_rad_ = 0.0;
  double step_rad_ = 0.0;
  double cos_step_ = 1.0;
  double sin_step_ = 0.0;
  bool clockwise_ = false;
  bool full_circle_ = false;
  bool even_seam_ = false;  ///< the step across the cut of the circle equals the others
  std::vector<float> cos_;
  std::vector<float> sin_;
  std::vector<std::int32_t> all_ranks_;  ///< 0, 1, 2 ...
  // The returns of the scan, counter-clockwise; on a full circle those before start_ are repeated behind the last.
  int start_ = 0;
  std::vector<std::int32_t> rank_;  ///< index of the beam, counted counter-clockwise; continues beyond the cut
  std::vector<float> range_;
  std::vector<float> squares_;  ///< NoiseEstimator::differences()
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> weight_;    ///< 0: left out
  std::vector<float> variance_;  ///< sigma_rho^2 / rho^2
  std::vector<Moments> sums_;    ///< entry i holds the sums of the returns before i
  std::vector<Piece> pieces_;
  std::vector<Piece> merged_;
  std::vector<std::pair<int, int>> stack_;
  std::vector<Scatter> scatters_;  ///< of the lines found
  Eigen::ArrayXf gap2_m2_;         ///< squared distance of each return of the row from the next
  Eigen::ArrayXf along_;           ///< scratch of noise_of()
  Eigen::ArrayXf weighted_;
  double max_variance_m2_ = 0.0;  ///< of any return of the scan
};

}  // namespace seeker::lines
