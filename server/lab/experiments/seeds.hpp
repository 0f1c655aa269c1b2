/// \file
/// Lists of seeds in the form that people write.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

/// Parses "3" or "1-20" or "1-3,7". kInvalidArgument: no number, a descending range, more than 10000 seeds.
[[nodiscard]] Result<std::vector<std::uint64_t>> parse_seeds(const std::string& text);
/// The shortest text that parse_seeds() reads as these seeds; they may be in any order.
[[nodiscard]] std::string print_seeds(std::vector<std::uint64_t> seeds);

/// A run for each seed, alike but for their member `seed`.
template <class Spec>
[[nodiscard]] std::vector<Spec> with_seeds(const Spec& spec, const std::vector<std::uint64_t>& seeds) {
  std::vector<Spec> specs(seeds.size(), spec);
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    specs[k].seed = seeds[k];
  }
  return specs;
}

/// The seeds of runs, each of which has a member `seed`, as that text.
template <class Run>
[[nodiscard]] std::string seeds_text(const std::vector<Run>& runs) {
  std::vector<std::uint64_t> seeds(runs.size());
  std::transform(runs.begin(), runs.end(), seeds.begin(), [](const Run& run) { return run.seed; });
  return print_seeds(std::move(seeds));
}

}  // namespace seeker::lab
