/// \file
/// Approximate best-bin-first search in a k-d tree, by which the paper matches (spec S2.1; Beis and Lowe): used where a
/// parameter `bbf_leaves` is above zero. Exact search (nearest_two()) is faster up to about ten thousand descriptors;
/// tests/bench/bench_stereo.cpp measures recall and time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/vision/descriptor.hpp"

namespace seeker::vision {

/// Number of leaves that the paper's search examines for each query.
inline constexpr int kPaperLeaves = 200;

struct BbfParams {
  int max_leaves = kPaperLeaves;  ///< number of leaves visited per query
  int leaf_size = 1;              ///< largest number of descriptors in a leaf

  friend bool operator==(const BbfParams&, const BbfParams&) = default;
};

/// A candidate that a search has found, with its distance as in NearestTwo.
struct NearCandidate {
  std::int32_t index = 0;
  std::uint32_t distance = 0;

  friend bool operator==(const NearCandidate&, const NearCandidate&) = default;
};

/// A tree over candidates that are copied; split on the dimension of largest variance at the median.
class BbfTree {
 public:
  BbfTree(std::span<const Descriptor> candidates, Metric metric, const BbfParams& params = {});

  [[nodiscard]] std::size_t size() const { return descriptors_.size(); }
  /// As nearest_two(), with indices into the candidates, but not necessarily the nearest ones; the distances are exact.
  /// The search is exact up to ties when max_leaves equals the number of candidates.
  [[nodiscard]] std::vector<NearestTwo> nearest_two(std::span<const Descriptor> queries) const;
  /// All candidates at most `distance` from the query among those that the search examines, by rising index. Complete
  /// when max_leaves equals the number of candidates.
  [[nodiscard]] std::vector<NearCandidate> within(const Descriptor& query, std::uint32_t distance) const;

 private:
  /// Inner nodes lead values up to `low` left and from `high` on right. Leaves hold candidates [first, last) of order_.
  struct Node {
    std::int32_t left = -1;  ///< negative for a leaf
    std::int32_t right = -1;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::uint8_t dimension = 0;
    std::uint8_t low = 0;
    std::uint8_t high = 0;
  };
  struct Search;

  std::int32_t build(std::uint32_t first, std::uint32_t last);
  [[nodiscard]] std::uint8_t widest_dimension(std::uint32_t first, std::uint32_t last) const;
  void run(Search& search) const;
  void descend(std::int32_t node, Search& search) const;
  void examine(const Node& leaf, Search& search) const;

  BbfParams params_;
  Metric metric_;
  std::vector<std::uint32_t> order_;     ///< indices of the candidates by leaf
  std::vector<Descriptor> descriptors_;  ///< in the order of order_
  std::vector<Node> nodes_;
};

/// vision::nearest_two() by a tree over the candidates that examines at most `bbf_leaves` leaves for each query; exact
/// where that is 0.
[[nodiscard]] std::vector<NearestTwo> nearest_two(std::span<const Descriptor> queries,
                                                  std::span<const Descriptor> candidates, Metric metric,
                                                  int bbf_leaves);

}  // namespace seeker::vision
