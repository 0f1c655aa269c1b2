#include "server/vision/bbf_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::vision {
namespace {

/// The variance of a large node is taken from as many of its members.
constexpr std::uint32_t kVarianceSample = 256;

/// A part of the tree that was passed by. `bound`: no descriptor in it is nearer to the query.
struct Branch {
  std::uint32_t bound = 0;
  std::int32_t node = 0;
  std::int32_t detour = -1;  ///< index of the last border crossed on the path to it
};

struct Farther {
  bool operator()(const Branch& a, const Branch& b) const { return a.bound > b.bound; }
};

/// A border that the path to a branch crosses, with the distance of the query from it.
struct Detour {
  std::int32_t earlier = -1;
  std::uint8_t dimension = 0;
  std::uint8_t offset = 0;
};

std::uint32_t cost(std::uint32_t offset, Metric metric) { return metric == Metric::kL1 ? offset : offset * offset; }

}  // namespace

struct BbfTree::Search {
  const Descriptor& query;
  NearestTwo nearest = {};
  /// All candidates up to this distance are wanted instead of the two nearest.
  std::optional<std::uint32_t> radius = std::nullopt;
  std::vector<NearCandidate> within = {};
  int leaves = 0;
  std::uint32_t bound = 0;   ///< of the branch that is descended
  std::int32_t detour = -1;  ///< its last one
  std::vector<Detour> detours = {};
  std::priority_queue<Branch, std::vector<Branch>, Farther> branches = {};

  /// Whether a branch with this bound cannot hold what is wanted.
  [[nodiscard]] bool too_far(std::uint32_t branch_bound) const {
    return radius ? branch_bound > *radius : branch_bound >= nearest.second_distance;
  }

  /// How far the query already is outside the branch along a dimension.
  [[nodiscard]] std::uint8_t offset_along(std::uint8_t dimension) const {
    for (std::int32_t i = detour; i >= 0; i = detours[static_cast<std::size_t>(i)].earlier) {
      if (detours[static_cast<std::size_t>(i)].dimension == dimension) {
        return detours[static_cast<std::size_t>(i)].offset;
      }
    }
    return 0;
  }

  /// Notes a branch whose border is `offset` away from the query.
  void pass_by(std::int32_t node, std::uint8_t dimension, std::uint8_t offset, Metric metric) {
    const std::uint8_t before = offset_along(dimension);
    const std::uint8_t now = std::max(before, offset);
    const std::uint32_t branch_bound = bound - cost(before, metric) + cost(now, metric);
    if (too_far(branch_bound)) {
      return;
    }
    detours.push_back({detour, dimension, now});
    branches.push({branch_bound, node, static_cast<std::int32_t>(detours.size()) - 1});
  }
};

BbfTree::BbfTree(std::span<const Descriptor> candidates, Metric metric, const BbfParams& params)
    : params_(params), metric_(metric), order_(candidates.size()), descriptors_(candidates.begin(), candidates.end()) {
  SEEKER_ASSERT(params.max_leaves >= 1 && params.leaf_size >= 1);
  std::iota(order_.begin(), order_.end(), 0U);
  if (!candidates.empty()) {
    nodes_.reserve(2 * candidates.size());
    build(0, static_cast<std::uint32_t>(candidates.size()));
  }
  // Leaves' members side by side: a search reads memory in order.
  std::transform(order_.begin(), order_.end(), descriptors_.begin(), [&](std::uint32_t i) { return candidates[i]; });
}

std::uint8_t BbfTree::widest_dimension(std::uint32_t first, std::uint32_t last) const {
  std::array<std::uint32_t, kDescriptorSize> sums{};
  std::array<std::uint32_t, kDescriptorSize> squares{};
  const std::uint32_t step = std::max(1U, (last - first) / kVarianceSample);
  double count = 0.0;
  for (std::uint32_t i = first; i < last; i += step) {
    const Descriptor& d = descriptors_[order_[i]];
    for (std::size_t k = 0; k < kDescriptorSize; ++k) {
      sums[k] += d[k];
      squares[k] += std::uint32_t{d[k]} * d[k];
    }
    count += 1.0;
  }
  std::size_t widest = 0;
  double largest = -1.0;
  for (std::size_t k = 0; k < kDescriptorSize; ++k) {
    const double variance = squares[k] - static_cast<double>(sums[k]) * sums[k] / count;
    if (variance > largest) {
      largest = variance;
      widest = k;
    }
  }
  return static_cast<std::uint8_t>(widest);
}

std::int32_t BbfTree::build(std::uint32_t first, std::uint32_t last) {
  const auto index = static_cast<std::int32_t>(nodes_.size());
  Node node;
  node.first = first;
  node.last = last;
  nodes_.push_back(node);
  if (last - first <= static_cast<std::uint32_t>(params_.leaf_size)) {
    return index;
  }
  node.dimension = widest_dimension(first, last);
  const auto value = [&](std::uint32_t i) { return descriptors_[i][node.dimension]; };
  const auto begin = order_.begin() + first;
  const auto end = order_.begin() + last;
  const auto middle = begin + (last - first) / 2;
  std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
    return value(a) != value(b) ? value(a) < value(b) : a < b;
  });
  const auto by_value = [&](std::uint32_t a, std::uint32_t b) { return value(a) < value(b); };
  node.low = value(*std::max_element(begin, middle, by_value));
  node.high = value(*middle);
  const auto split = static_cast<std::uint32_t>(middle - order_.begin());
  node.left = build(first, split);
  node.right = build(split, last);
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

void BbfTree::examine(const Node& leaf, Search& search) const {
  ++search.leaves;
  for (std::uint32_t i = leaf.first; i < leaf.last; ++i) {
    const auto index = static_cast<std::int32_t>(order_[i]);
    const std::uint32_t distance = descriptor_distance(search.query, descriptors_[i], metric_);
    if (!search.radius) {
      search.nearest.offer(index, distance);
    } else if (distance <= *search.radius) {
      search.within.push_back({index, distance});
    }
  }
}

void BbfTree::descend(std::int32_t node_index, Search& search) const {
  const Node* node = &nodes_[static_cast<std::size_t>(node_index)];
  while (node->left >= 0) {
    const int value = search.query[node->dimension];
    const bool go_left = 2 * value <= int{node->low} + int{node->high};
    const int offset = go_left ? int{node->high} - value : value - int{node->low};
    search.pass_by(go_left ? node->right : node->left, node->dimension, static_cast<std::uint8_t>(std::max(0, offset)),
                   metric_);
    node = &nodes_[static_cast<std::size_t>(go_left ? node->left : node->right)];
  }
  examine(*node, search);
}

void BbfTree::run(Search& search) const {
  if (!nodes_.empty()) {
    descend(0, search);
  }
  while (!search.branches.empty() && search.leaves < params_.max_leaves) {
    const Branch next = search.branches.top();
    search.branches.pop();
    if (search.too_far(next.bound)) {
      break;  // all others are further still
    }
    search.bound = next.bound;
    search.detour = next.detour;
    descend(next.node, search);
  }
}

std::vector<NearestTwo> BbfTree::nearest_two(std::span<const Descriptor> queries) const {
  std::vector<NearestTwo> found;
  found.reserve(queries.size());
  for (const Descriptor& query : queries) {
    Search search{.query = query};
    run(search);
    found.push_back(search.nearest);
  }
  return found;
}

std::vector<NearCandidate> BbfTree::within(const Descriptor& query, std::uint32_t distance) const {
  Search search{.query = query, .radius = distance};
  run(search);
  std::sort(search.within.begin(), search.within.end(),
            [](const NearCandidate& a, const NearCandidate& b) { return a.index < b.index; });
  return std::move(search.within);
}

std::vector<NearestTwo> nearest_two(std::span<const Descriptor> queries, std::span<const Descriptor> candidates,
                                    Metric metric, int bbf_leaves) {
  if (bbf_leaves <= 0) {
    return nearest_two(queries, candidates, metric);
  }
  return BbfTree(candidates, metric, {.max_leaves = bbf_leaves}).nearest_two(queries);
}

}  // namespace seeker::vision
