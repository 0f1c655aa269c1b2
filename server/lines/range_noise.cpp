#include "server/lines/range_noise.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include <Eigen/Core>

namespace seeker::lines {
namespace {

/// Bins of the histograms are the leading bits of a float: 2 bins an octave, the first at 2^-28 m^2 = (0.06 mm)^2.
constexpr unsigned kBinShift = 22U;
constexpr std::uint32_t kFirstBin = (127U - 28U) << (23U - kBinShift);
/// Range octaves begin at 0.25 m.
constexpr std::uint32_t kFirstOctave = 127U - 2U;

/// Lower edge of a bin in m^2.
double bin_edge(std::size_t bin) {
  return static_cast<double>(std::bit_cast<float>((kFirstBin + static_cast<std::uint32_t>(bin)) << kBinShift));
}

/// `value - first` within 0 .. count - 1.
std::size_t clamp_index(std::uint32_t value, std::uint32_t first, std::size_t count) {
  return std::min<std::size_t>(value > first ? value - first : 0U, count - 1);
}

}  // namespace

void NoiseEstimator::differences(std::span<const float> ranges_m, std::span<const std::int32_t> beams, double step_rad,
                                 std::int32_t circle, std::vector<float>& squares_m2) {
  constexpr float kUnknown = std::numeric_limits<float>::infinity();
  const auto n = static_cast<Eigen::Index>(ranges_m.size());
  squares_m2.resize(ranges_m.size());
  inverse_.resize(ranges_m.size());
  if (n < 3) {
    std::fill(squares_m2.begin(), squares_m2.end(), kUnknown);
    return;
  }
  using Map = Eigen::Map<Eigen::ArrayXf>;
  Map inverse(inverse_.data(), n);
  inverse = Eigen::Map<const Eigen::ArrayXf>(ranges_m.data(), n).inverse();
  const auto before = inverse.head(n - 2);
  const auto middle = inverse.segment(1, n - 2);
  const auto after = inverse.tail(n - 2);
  const auto factor = static_cast<float>(2.0 * std::cos(step_rad));
  // d(1/rho) = -d rho / rho^2: the variance of the difference is sigma^2 times this.
  const auto gain = before.square().square() + factor * factor * middle.square().square() + after.square().square();
  Map(squares_m2.data() + 1, n - 2) = (before - factor * middle + after).square() / gain;
  squares_m2.front() = kUnknown;
  squares_m2.back() = kUnknown;
  const std::size_t last = beams.size() - 1;
  if (circle > 0 && beams[0] == 0 && beams[last] == circle - 1) {
    if (beams[1] == 1) {
      squares_m2[0] = difference(ranges_m[last], ranges_m[0], ranges_m[1], step_rad);
    }
    if (beams[last - 1] == circle - 2) {
      squares_m2[last] = difference(ranges_m[last - 1], ranges_m[last], ranges_m[0], step_rad);
    }
  }
  if (beams[last] - beams[0] == static_cast<std::int32_t>(n) - 1) {
    return;
  }
  for (std::size_t i = 1; i + 1 < beams.size(); ++i) {
    if (beams[i + 1] - beams[i - 1] != 2) {
      squares_m2[i] = kUnknown;
    }
  }
}

float NoiseEstimator::difference(float before_m, float range_m, float after_m, double step_rad) {
  const auto factor = static_cast<float>(2.0 * std::cos(step_rad));
  const float before = 1.0F / before_m;
  const float middle = 1.0F / range_m;
  const float after = 1.0F / after_m;
  const float d = before - factor * middle + after;
  const auto fourth = [](float v) { return v * v * v * v; };
  return d * d / (fourth(before) + factor * factor * fourth(middle) + fourth(after));
}

double NoiseEstimator::robust_variance(const Octave& octave) {
  // Median of chi-square with one degree of freedom, and where 3 sigma are.
  constexpr double kMedianOfChi2 = 0.4549;
  constexpr double kOutlier = 9.0;
  double variance = 0.0;
  std::size_t limit = kBins;
  // The second median is of what the first one takes for noise: edges then count as little as they should.
  for (int pass = 0; pass < 2; ++pass) {
    const int count = limit == kBins ? octave.count
                                     : std::accumulate(octave.bins.begin(),
                                                       octave.bins.begin() + static_cast<std::ptrdiff_t>(limit), 0);
    double left = 0.5 * count;
    std::size_t bin = 0;
    while (bin + 1 < limit && left > octave.bins[bin]) {
      left -= octave.bins[bin++];
    }
    const double low = bin_edge(bin);
    const double share = octave.bins[bin] > 0 ? left / octave.bins[bin] : 0.0;
    variance = (low + share * (bin_edge(bin + 1) - low)) / kMedianOfChi2;
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(kOutlier * variance)) >> kBinShift;
    limit = 1 + clamp_index(bits, kFirstBin, kBins);
  }
  return variance;
}

RangeNoise NoiseEstimator::fit_law(const NoiseParams& params) const {
  // Weighted regression of sigma^2 on rho^2 over the octaves. A variance from a median of n overlapping differences
  // has a relative standard deviation of about sqrt(8 / n).
  constexpr double kMedianVariance = 8.0;
  constexpr int kMinOctave = 16;
  double sw = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (const Octave& octave : octaves_) {
    if (octave.count >= kMinOctave || (octave.count > 0 && octave.count >= params.min_samples)) {
      const double y = robust_variance(octave);
      const double x = octave.range2_m2 / octave.count;
      const double w = octave.count;
      sw += w;
      sx += w * x;
      sy += w * y;
      sxx += w * x * x;
      sxy += w * x * y;
    }
  }
  const double min2 = params.min_sigma_m * params.min_sigma_m;
  const double max2 = params.max_sigma_m * params.max_sigma_m;
  if (sw < params.min_samples || sw <= 0.0) {
    return {params.nominal_sigma_m, 0.0};
  }
  const double mean = std::clamp(sy / sw, min2, max2);
  const double spread = sxx - sx * sx / sw;
  if (spread > 0.0) {
    const double slope2 = (sxy - sx * sy / sw) / spread;
    const double slope2_sigma = mean * std::sqrt(kMedianVariance / spread);
    if (slope2 > params.slope_significance * slope2_sigma) {
      return {std::sqrt(std::clamp(mean - slope2 * sx / sw, min2, max2)), std::sqrt(slope2)};
    }
  }
  return {std::sqrt(mean), 0.0};
}

RangeNoise NoiseEstimator::estimate(std::span<const float> ranges_m, std::span<const float> squares_m2,
                                    const NoiseParams& params) {
  if (params.sigma_m > 0.0) {
    return {params.sigma_m, params.slope};
  }
  octaves_.fill(Octave{});
  // Neighbours are mostly in the same octave: its sums stay in registers.
  Octave* octave = octaves_.data();
  float low_m = 0.0F;
  float high_m = 0.0F;
  int count = 0;
  double range2 = 0.0;
  const auto put_down = [&] {
    octave->count += count;
    octave->range2_m2 += range2;
    count = 0;
    range2 = 0.0;
  };
  for (std::size_t i = 0; i < squares_m2.size(); ++i) {
    const float square = squares_m2[i];
    // Corners and unknowns: nothing above 1 m is noise.
    if (!(square < 1.0F)) {
      continue;
    }
    const float range = ranges_m[i];
    if (!(range >= low_m && range < high_m)) {
      put_down();
      const std::uint32_t exponent = std::bit_cast<std::uint32_t>(range) >> 23U;
      octave = &octaves_[clamp_index(exponent, kFirstOctave, kOctaves)];
      low_m = std::bit_cast<float>(exponent << 23U);
      high_m = 2.0F * low_m;
    }
    ++octave->bins[clamp_index(std::bit_cast<std::uint32_t>(square) >> kBinShift, kFirstBin, kBins)];
    ++count;
    range2 += static_cast<double>(range * range);
  }
  put_down();
  return fit_law(params);
}

}  // namespace seeker::lines
