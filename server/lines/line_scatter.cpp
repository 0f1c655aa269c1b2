// How noisy a scan is by what its own lines say.
#include <algorithm>
#include <cmath>

#include "server/lines/fast_extractor.hpp"

namespace seeker::lines {

/// Variance of this scan in units of what its neighbouring beams made believe: edges and short corners are among those,
/// and what the bearings are off by is in their ranges and stated beside them.
double FastExtractor::noise_factor() const {
  double sum = 0.0;
  double dof = 0.0;
  for (const Scatter& scatter : scatters_) {
    if (scatter.excess <= 1.0 + params_.excess_sigmas * std::sqrt(2.0 / scatter.dof)) {
      sum += scatter.excess * scatter.dof;
      dof += scatter.dof;
    }
  }
  if (params_.noise.sigma_m > 0.0 || dof < params_.noise.min_samples) {
    return 1.0;
  }
  const double least_sigma = std::min(1.0, params_.noise.min_sigma_m / noise_.floor_m);
  // What is stated in units of an estimate errs like Student's t, whose variance is dof / (dof - 2).
  return std::max(sum / std::max(dof - 2.0, 1.0), least_sigma * least_sigma);
}

void FastExtractor::settle_noise(ScanLines& found) {
  const double factor = noise_factor();
  for (std::size_t k = 0; k < found.lines.size(); ++k) {
    // A worse fit than the noise explains says that this wall is worse than believed.
    const Scatter& scatter = scatters_[k];
    const bool crooked = scatter.excess > factor * (1.0 + params_.inflation_sigmas * std::sqrt(2.0 / scatter.dof));
    found.lines[k].covariance *= crooked ? scatter.excess : factor;
  }
  noise_.floor_m *= std::sqrt(factor);
  noise_.slope *= std::sqrt(factor);
}

}  // namespace seeker::lines
