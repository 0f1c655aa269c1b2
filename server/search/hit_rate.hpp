/// \file
/// Probability that one picture shows a target that is there: the recogniser's measured hit rate as a curve.
#pragma once

#include "common/core/result.hpp"

namespace seeker::search {

/// Parametric curve; the defaults are conservative for template matching in the 640x480 omnidirectional picture and are
/// replaced by measured values from the configuration.
struct HitRate {
  double best = 0.85;          ///< probability for a large, near target in full view
  double half_size_px = 16.0;  ///< apparent size at which the rate has fallen to half of `best`
  double size_slope_px = 2.5;  ///< width of that decrease (logistic)
  double min_range_m = 0.30;   ///< below this range the robot's own body or the mirror's rim hides the target
  double max_range_m = 4.0;    ///< beyond this range the probability is 0
  /// Angular resolution of the camera across the view; of the horizon circle where it is omnidirectional.
  double pixels_per_rad = 190.0;
  /// Mean factor on the apparent size, because flat pictures are seen at an angle.
  double mean_view_foreshortening = 0.8;

  /// Probability of detection of a target `size_m` across at `range_m`, 0..1. Falls with range, rises with size.
  [[nodiscard]] double probability(double range_m, double size_m) const;
};

[[nodiscard]] Status validate(const HitRate& rate);

}  // namespace seeker::search
