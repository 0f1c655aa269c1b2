/// \file
/// Measures how often the recogniser finds a target that is in view, against range; the evidence of searches rests on
/// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/solid.hpp"
#include "server/lab/search/search_run.hpp"
#include "server/search/hit_rate.hpp"

namespace seeker::lab {

struct HitRateParams {
  RunSpec spec;                    ///< world, robot file and overrides; its seed is not used
  std::optional<SolidKind> solid;  ///< that of the world instead of its target, by a camera that looks one way
  std::vector<std::uint64_t> seeds;
  double range_min_m = 0.4;
  double range_max_m = 5.0;
  double range_step_m = 0.2;
  int directions = 8;             ///< places around the target per range and seed
  double bearing_gate_deg = 5.0;  ///< a sighting within it of the truth is a hit, another one is false
};

/// Pictures of one range.
struct HitRateBin {
  double range_m = 0.0;
  int pictures = 0;
  int hits = 0;
  int false_sightings = 0;

  [[nodiscard]] double rate() const { return pictures > 0 ? static_cast<double>(hits) / pictures : 0.0; }
};

/// The solid, or the world's target.
[[nodiscard]] Result<api::TargetSpec> studied_target(const sim::World& world, const HitRateParams& params);

/// Every picture is taken from a place with room for the robot and a clear line (laser height) to the target, which
/// stands at a place drawn from the seed. A solid is alone in its world, turned anyhow, and so far from the picture's
/// middle at most as the nearest picture of a round has it.
[[nodiscard]] Result<std::vector<HitRateBin>> measure_hit_rate(const HitRateParams& params);

/// The curve that makes the measured hits most likely; `size_m` is the target's smaller side. Ranges beyond the last
/// one with a rate of `least_rate` get no credit.
[[nodiscard]] search::HitRate fit_hit_rate(const std::vector<HitRateBin>& bins, double size_m,
                                           const search::HitRate& camera);

[[nodiscard]] std::string hit_rate_csv(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& fit);
/// The section of a robot file that makes a search use the curve.
[[nodiscard]] std::string hit_rate_yaml(const search::HitRate& fit);
[[nodiscard]] Image hit_rate_chart(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& fit,
                                   const search::HitRate& before);

}  // namespace seeker::lab
