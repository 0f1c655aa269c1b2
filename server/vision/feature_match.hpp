/// \file
/// Matching of the features of two pictures by their descriptors alone.
#pragma once

#include <span>
#include <vector>

#include "server/vision/descriptor.hpp"

namespace seeker::vision {

/// Indices of two matching features in their lists.
struct FeatureMatch {
  int first = 0;
  int second = 0;

  friend bool operator==(const FeatureMatch&, const FeatureMatch&) = default;
};

struct MatchParams {
  Metric metric = Metric::kL2;
  double max_distance = 2.0;  ///< distance of unit descriptors; L2: no two are farther apart
  double max_ratio =
      0.8;  ///< best over second best distance, in either direction; 1: the best must only be nearer than the second

  friend bool operator==(const MatchParams&, const MatchParams&) = default;
};

/// Converts a distance of bytes into that of unit descriptors.
[[nodiscard]] double unit_distance(std::uint32_t distance, Metric metric);
/// The largest distance of bytes that is at most `distance` of unit descriptors.
[[nodiscard]] std::uint32_t byte_distance(double distance, Metric metric);
/// Whether `best` is below `ratio` times `second`, both of bytes.
[[nodiscard]] bool is_distinct(std::uint32_t best, std::uint32_t second, Metric metric, double ratio);

/// Mutually best pairs that pass both gates, in the order of `first`: every feature is in at most one (vision.md 1.4).
[[nodiscard]] std::vector<FeatureMatch> match_mutually(std::span<const Descriptor> first,
                                                       std::span<const Descriptor> second, const MatchParams& params);

}  // namespace seeker::vision
