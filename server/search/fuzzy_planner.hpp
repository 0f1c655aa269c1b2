/// \file
/// The fuzzy local planner on fuzzylite (spec S3.2). It is the slow reference implementation that others are compared
/// with.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "common/core/result.hpp"
#include "server/search/sectors.hpp"

namespace seeker::search {

/// Why a planner has no heading change to offer. The robot must stop.
enum class PlannerStop : std::uint8_t {
  kInvalidInput,  ///< a distance or the target's bearing is NaN or infinite
  kNoRule,        ///< no rule fired: the output would be undefined
};
[[nodiscard]] std::string_view to_string(PlannerStop stop);

/// Heading change u* in rad, positive to the left, or the reason to stop.
using HeadingResult = tl::expected<double, PlannerStop>;

/// One inference engine. It must not be shared between threads, because the engine stores its inputs.
class FuzzyPlanner {
 public:
  /// Reads an engine in the FuzzyLite Language (see generate_fll() and config/fuzzy/planner.fll). It refuses text that
  /// does not parse, that lacks one of the six inputs or the output, or that has no rules.
  [[nodiscard]] static Result<FuzzyPlanner> create(const std::string& fll_text);

  FuzzyPlanner(FuzzyPlanner&&) noexcept;
  FuzzyPlanner& operator=(FuzzyPlanner&&) noexcept;
  FuzzyPlanner(const FuzzyPlanner&) = delete;
  FuzzyPlanner& operator=(const FuzzyPlanner&) = delete;
  ~FuzzyPlanner();

  /// Mamdani inference: AND = min, implication = min, aggregation = max, centroid over 361 samples.
  /// \param target_rad bearing of the target in the base, left positive; wrapped to (-pi, pi].
  [[nodiscard]] HeadingResult infer(const Sectors& sectors, double target_rad);

  [[nodiscard]] std::size_t rule_count() const;

 private:
  struct Impl;
  explicit FuzzyPlanner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::search
