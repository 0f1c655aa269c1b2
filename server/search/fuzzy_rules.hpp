/// \file
/// The rule base of the local planner, generated from one law instead of being tabulated (spec S3.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace seeker::search {

/// Fused sonar sectors, left to right (spec S3.1).
enum class Sector : std::uint8_t { kLeft, kLeftFront, kFront, kRightFront, kRight };
inline constexpr std::size_t kSectors = 5;
/// Sets of the target's bearing and of the heading change: -2 (NB, TNB) .. +2 (PB, TPB).
inline constexpr std::size_t kLevels = 5;

/// Break points of the membership functions (spec S3.2), as in config/fuzzy/planner.fll.
inline constexpr double kNearFull_m = 0.4;     ///< NEAR is 1 up to here
inline constexpr double kNearNone_m = 1.0;     ///< NEAR is 0 from here on, linear between
inline constexpr double kMaxDistance_m = 3.0;  ///< sectors are clipped to [0, 3] m
inline constexpr int kCentroidSamples = 361;   ///< samples of the output's universe [-pi, pi]

/// IF the sectors are near or far as in `near` AND the target is at `target` THEN the heading change is `output`.
struct FuzzyRule {
  std::array<bool, kSectors> near{};  ///< in the order of Sector; false means FAR
  int target = 0;                     ///< -2 .. 2
  int output = 0;                     ///< -2 .. 2

  friend bool operator==(const FuzzyRule&, const FuzzyRule&) = default;
};

/// Heading level of a sector: L = +2, LF = +1, F = 0, RF = -1, R = -2.
[[nodiscard]] constexpr int level_of(std::size_t sector) { return 2 - static_cast<int>(sector); }

/// The law of spec S3.2: the output is the free sector closest to the target's, with ties to the smaller |k| and then
/// to the left. With no free sector it is far left. Straight ahead beside a single near flank is changed by one level
/// away from it.
[[nodiscard]] int output_level(const std::array<bool, kSectors>& near, int target);

/// All 2^5 x 5 = 160 rules: sectors count in binary with L as the highest bit (NEAR = 1), the target varies fastest.
[[nodiscard]] std::vector<FuzzyRule> generate_rules();

/// The whole engine (sets, operators, rules) in the FuzzyLite Language: the contents of config/fuzzy/planner.fll.
[[nodiscard]] std::string generate_fll();

}  // namespace seeker::search
