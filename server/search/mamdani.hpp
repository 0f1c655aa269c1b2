/// \file
/// Direct implementation of the planner's inference, many times faster than the general engine; it fills control
/// tables. A test compares it with FuzzyPlanner; bench_fuzzy measures both.
#pragma once

#include <array>
#include <vector>

#include "server/search/fuzzy_planner.hpp"
#include "server/search/fuzzy_rules.hpp"

namespace seeker::search {

/// The generated rule base of spec S3.2 with sampled output sets. Immutable, may be shared between threads.
class MamdaniPlanner {
 public:
  MamdaniPlanner();

  /// Same meaning and same result (to rounding) as FuzzyPlanner::infer on generate_fll().
  [[nodiscard]] HeadingResult infer(const Sectors& sectors, double target_rad) const;

 private:
  using Activation = std::array<double, kLevels>;
  [[nodiscard]] Activation activate(const Sectors& sectors, double target_rad) const;

  std::vector<FuzzyRule> rules_;
  std::array<double, kCentroidSamples> sample_rad_{};
  std::array<std::array<double, kLevels>, kCentroidSamples> output_sets_{};
};

/// Membership in NEAR; FAR is 1 - NEAR.
[[nodiscard]] double near_membership(double distance_m);
/// Membership of a bearing in NB..PB (level -2..2), the outer two saturating.
[[nodiscard]] double target_membership(int level, double target_rad);
/// Membership of a heading change in TNB..TPB (level -2..2), plain triangles.
[[nodiscard]] double heading_change_membership(int level, double heading_change_rad);

}  // namespace seeker::search
