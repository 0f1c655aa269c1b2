#include "server/search/hit_rate.hpp"

#include <cmath>

namespace seeker::search {

double HitRate::probability(double range_m, double size_m) const {
  if (!(range_m >= min_range_m) || !(range_m <= max_range_m) || !(size_m > 0.0)) {
    return 0.0;
  }
  const double across_rad = 2.0 * std::atan(size_m / (2.0 * range_m));
  const double size_px = mean_view_foreshortening * across_rad * pixels_per_rad;
  return best / (1.0 + std::exp(-(size_px - half_size_px) / size_slope_px));
}

Status validate(const HitRate& rate) {
  const bool sane = rate.best > 0.0 && rate.best <= 1.0 && rate.half_size_px > 0.0 && rate.size_slope_px > 0.0 &&
                    rate.min_range_m >= 0.0 && rate.max_range_m > rate.min_range_m && rate.max_range_m <= 50.0 &&
                    rate.pixels_per_rad > 0.0 && rate.mean_view_foreshortening > 0.0 &&
                    rate.mean_view_foreshortening <= 1.0;
  if (!sane) {
    return fail(Errc::kInvalidArgument,
                "the hit rate needs best in (0, 1], positive sizes and 0 <= min_range < max_range <= 50 m");
  }
  return {};
}

}  // namespace seeker::search
