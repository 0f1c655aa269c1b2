#include "server/vision/feature_match.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::vision {

double unit_distance(std::uint32_t distance, Metric metric) {
  const auto value = static_cast<double>(distance);
  return (metric == Metric::kL1 ? value : std::sqrt(value)) / kDescriptorUnit;
}

std::uint32_t byte_distance(double distance, Metric metric) {
  const double bytes = distance * kDescriptorUnit;
  const double value = metric == Metric::kL1 ? bytes : bytes * bytes;
  return static_cast<std::uint32_t>(std::clamp(value, 0.0, static_cast<double>(NearestTwo::kFar) - 1.0));
}

bool is_distinct(std::uint32_t best, std::uint32_t second, Metric metric, double ratio) {
  const double factor = metric == Metric::kL1 ? ratio : ratio * ratio;
  return static_cast<double>(best) < factor * static_cast<double>(second);
}

std::vector<FeatureMatch> match_mutually(std::span<const Descriptor> first, std::span<const Descriptor> second,
                                         const MatchParams& params) {
  const std::uint32_t gate = byte_distance(params.max_distance, params.metric);
  const auto passes = [&](const NearestTwo& n) {
    return n.best != NearestTwo::kNone && n.best_distance <= gate &&
           is_distinct(n.best_distance, n.second_distance, params.metric, params.max_ratio);
  };
  const std::vector<NearestTwo> forth = nearest_two(first, second, params.metric);
  std::vector<FeatureMatch> one_way;
  std::vector<Descriptor> named;  // only those must name back
  for (std::size_t i = 0; i < forth.size(); ++i) {
    if (passes(forth[i])) {
      one_way.push_back({static_cast<int>(i), forth[i].best});
      named.push_back(second[static_cast<std::size_t>(forth[i].best)]);
    }
  }
  const std::vector<NearestTwo> back = nearest_two(named, first, params.metric);
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < back.size(); ++i) {
    if (back[i].best == one_way[i].first && passes(back[i])) {
      matches.push_back(one_way[i]);
    }
  }
  return matches;
}

}  // namespace seeker::vision
