/// \file
/// Measures how often the recogniser finds a target in view, as a function of range; the evidence of searches is based
/// on this rate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/solid.hpp"
#include "server/lab/search/search_run.hpp"
#include "server/search/hit_rate.hpp"

namespace seeker::lab {

struct HitRateParams {
  RunSpec spec;  ///< world, robot file and overrides; its seed is not used
  /// That solid of the world instead of its target, seen by a camera with a limited view.
  std::optional<SolidKind> solid;
  std::vector<std::uint64_t> seeds;
  double range_min_m = 0.4;
  double range_max_m = 5.0;
  double range_step_m = 0.2;
  int directions = 8;             ///< number of viewpoints around the target for each range and seed
  double bearing_gate_deg = 5.0;  ///< a sighting within this angle of the true bearing is a hit, any other one is false
};

/// Counts of the pictures at one range.
struct HitRateBin {
  double range_m = 0.0;
  int pictures = 0;
  int hits = 0;
  int false_sightings = 0;

  [[nodiscard]] double rate() const { return pictures > 0 ? static_cast<double>(hits) / pictures : 0.0; }
};

/// The target of the study: the solid, or the world's target.
[[nodiscard]] Result<api::TargetSpec> studied_target(const sim::World& world, const HitRateParams& params);

/// Takes every picture from a place with room for the robot and an unobstructed line (laser height) to the target,
/// which stands at a place drawn from the seed. A solid is alone in its world, with random heading, and at most as far
/// from the picture's middle as in the nearest picture of a round.
[[nodiscard]] Result<std::vector<HitRateBin>> measure_hit_rate(const HitRateParams& params);

/// Fits the curve with the largest likelihood of the measured hits; `size_m` is the target's smaller side. Ranges
/// beyond the last one with a rate of `least_rate` have probability 0.
[[nodiscard]] search::HitRate fit_hit_rate(const std::vector<HitRateBin>& bins, double size_m,
                                           const search::HitRate& camera);

[[nodiscard]] std::string hit_rate_csv(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& fit);
/// The section of a robot file that makes a search use the curve.
[[nodiscard]] std::string hit_rate_yaml(const search::HitRate& fit);
[[nodiscard]] Image hit_rate_chart(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& fit,
                                   const search::HitRate& before);

}  // namespace seeker::lab
