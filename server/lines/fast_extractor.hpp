/// \file
/// Lines of a scan in O(n): running sums, iterative split and merge, noise told by the scan (spec S5; S1.4 steps 1-2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/lines/line.hpp"
#include "server/lines/line_fit.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

struct FastParams {
  NoiseParams noise;
  double bearing_sigma_rad = 0.0;  ///< of the beams; 0: their directions are exact
  double straightness_m = 0.0;     ///< how far a wall may be off a straight line, beside the noise
  double max_gap_m = 0.15;         ///< neighbours farther apart begin a new group, unless they are in line
  double max_gap_spacings = 3.0;   ///< the same in spacings of beams at their range (spec S1.4 step 1)
  double in_line_sigmas = 4.0;     ///< a gap between points in line with a neighbour does not begin a group
  int max_missing_beams = 2;       ///< more beams without return begin a new group
  double split_sigmas = 4.0;       ///< a point farther from the line splits it
  double excess_sigmas = 4.0;      ///< ... as does a mean square that is over the noise by so many standard deviations
  double merge_sigmas = 5.0;       ///< ... but two pieces of one line may have one so far off
  double bend_chi2 = 16.0;         ///< two parts are one line unless two lines explain them better than by this
  double max_merge_gap_m = 0.2;    ///< ends of two pieces of one line are not farther apart (spec S5.6)
  double corner_sigmas = 3.0;      ///< nearer to the next wall's line, noise decides which of the two a point is of
  double corner_doubt = 1.0;       ///< ... and such a point is off by this much more variance, in units of its noise
  double inflation_sigmas = 2.0;   ///< the covariance grows with a mean square that is over the noise by more than this
  int max_outliers = 3;            ///< so many points between two pieces of one line are left out
  int min_points = 8;              ///< of a line (spec S1.4 step 2d)
  double min_length_m = 0.3;
  double min_range_m = 0.05;  ///< nearer returns are not believed, whatever the scanner says
  double max_range_m = 0.0;   ///< farther returns are left out; 0: the scanner's own limit
};

/// Keeps its buffers and the sines of the scanner's beams: use one per scanner. The result depends on the scan alone.
class FastExtractor {
 public:
  explicit FastExtractor(const FastParams& params = {}) : params_(params) {}

  /// Lines of a scan, which must have passed validate(). `found` is overwritten; its memory is used again.
  void extract(const LaserScan& scan, ScanLines& found);
  [[nodiscard]] ScanLines extract(const LaserScan& scan);

  [[nodiscard]] const FastParams& params() const { return params_; }
  /// Noise of the scan extracted last.
  [[nodiscard]] const RangeNoise& noise() const { return noise_; }

 private:
  /// Beams that graze the wall at a smaller cosine are not believed to know it any better.
  static constexpr double kMinCosine = 0.05;
  /// Splitting ends at pieces of fewer points: any three are nearly a line.
  static constexpr int kMinPiece = 4;

  /// Returns first..last (inclusive), those left out among them not in `sums`.
  struct Piece {
    int first = 0;
    int last = 0;
    int points = 0;
    Moments sums;
    double across_m2 = 0.0;  ///< LineFit::across_m2
    LineFit fit;             ///< of pieces that are lines; fragments have none
    int doubtful_first = 0;  ///< so many returns at its begin may be the wall's before,
    int doubtful_last = 0;   ///< so many at its end the next one's
  };

  /// How a line's points lie about it: their mean square in units of what the noise explains.
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
  bool even_seam_ = false;  ///< the step over the cut is like any other
  std::vector<float> cos_;
  std::vector<float> sin_;
  std::vector<std::int32_t> all_ranks_;  ///< 0, 1, 2 ...
  // The returns of the scan, counter-clockwise; on a full circle those before start_ once more behind the last.
  int start_ = 0;
  std::vector<std::int32_t> rank_;  ///< beam, counted counter-clockwise; goes on beyond the cut
  std::vector<float> range_;
  std::vector<float> squares_;  ///< NoiseEstimator::differences()
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> weight_;    ///< 0: left out
  std::vector<float> variance_;  ///< sigma_rho^2 / rho^2
  std::vector<Moments> sums_;    ///< entry i: of the returns before i
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
