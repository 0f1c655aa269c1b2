/// \file
/// Estimation of the range noise of a scan from the scan itself.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace seeker::lines {

/// The noise law sigma^2(rho) = floor^2 + (slope rho)^2.
struct RangeNoise {
  double floor_m = 0.01;
  double slope = 0.0;  ///< metres per metre of range; 0: independent of the range

  [[nodiscard]] double variance_m2(double range_m) const {
    return floor_m * floor_m + slope * slope * range_m * range_m;
  }
  [[nodiscard]] double sigma_m(double range_m) const { return std::sqrt(variance_m2(range_m)); }
};

struct NoiseParams {
  double sigma_m = 0.0;           ///< known noise without an estimate; 0: estimated from each scan
  double slope = 0.0;             ///< with a known sigma_m: the part proportional to the range
  double nominal_sigma_m = 0.01;  ///< used where a scan has too few beams for an estimate (spec S5.5: LMS200)
  double min_sigma_m = 0.002;     ///< lower limit of the estimate (ranges are rounded)
  double max_sigma_m = 0.1;       ///< upper limit of the estimate (clutter looks like noise)
  int min_samples = 20;           ///< number of neighbours in line below which nominal_sigma_m is used
  /// Number of standard deviations from which on a growth with the range is significant.
  double slope_significance = 4.0;
};

/// Estimates the noise from the differences of three neighbouring beams. On a straight wall 1/rho is a sinusoid of the
/// bearing, so that 1/rho(i-1) - 2 cos(step) / rho(i) + 1/rho(i+1) = 0 exactly, at any angle to the wall; the residual
/// is noise, and corners and edges are the few outliers that a median ignores. O(n): the medians come from histograms.
class NoiseEstimator {
 public:
  /// Squared second differences of 1/range in units of m^2 of range variance, entry i about point i; +inf where a
  /// neighbour is missing. `beams` ascend; neighbours differ by one. `circle`: number of beams of a scanner whose last
  /// beam is as far from the first as any two, else 0.
  void differences(std::span<const float> ranges_m, std::span<const std::int32_t> beams, double step_rad,
                   std::int32_t circle, std::vector<float>& squares_m2);
  /// The squared difference of one point and its two neighbours.
  [[nodiscard]] static float difference(float before_m, float range_m, float after_m, double step_rad);
  [[nodiscard]] RangeNoise estimate(std::span<const float> ranges_m, std::span<const float> squares_m2,
                                    const NoiseParams& params);

 private:
  /// Histograms of log2(square), by octave of range.
  static constexpr std::size_t kOctaves = 8;
  static constexpr std::size_t kBins = 64;
  struct Octave {
    std::array<std::uint16_t, kBins> bins{};
    int count = 0;
    double range2_m2 = 0.0;  ///< sum of the squared ranges
  };
  [[nodiscard]] static double robust_variance(const Octave& octave);
  [[nodiscard]] RangeNoise fit_law(const NoiseParams& params) const;

  std::array<Octave, kOctaves> octaves_;
  std::vector<float> inverse_;
};

}  // namespace seeker::lines
