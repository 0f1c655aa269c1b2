/// \file
/// The history of the automatic thresholds of the paper's detector (spec S5.4), as a table, a figure and a condition.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "server/lab/experiments/check.hpp"

namespace seeker::lab {

/// Table and figure of one reproduction.
struct ThresholdHistory {
  std::string csv;  ///< a row for each round of each packet of the first seed
  Image figure;     ///< thresholds and worst fit error over the rounds of those packets
};

/// Runs the detector as printed from its initial thresholds and from twice those, on the scan of Table 1 for each seed,
/// and checks that every packet ended with a fit within 5 mm or with thresholds that cannot shrink further.
[[nodiscard]] ThresholdHistory check_history(const std::vector<std::uint64_t>& seeds, Report& report);

}  // namespace seeker::lab
