/// \file
/// Best-bin-first search in a k-d tree, as the paper has it (spec S2.1; Beis and Lowe): approximate. Exact search
/// (nearest_two()) is faster up to some ten thousand descriptors; tests/bench/bench_stereo.cpp tells recall and time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/vision/descriptor.hpp"

namespace seeker::vision {

struct BbfParams {
  int max_leaves = 200;  ///< looked at per query
  int leaf_size = 1;     ///< descriptors in a leaf at most

  friend bool operator==(const BbfParams&, const BbfParams&) = default;
};

/// A tree over candidates that are copied; split on the dimension of largest variance at the median.
class BbfTree {
 public:
  BbfTree(std::span<const Descriptor> candidates, Metric metric, const BbfParams& params = {});

  [[nodiscard]] std::size_t size() const { return descriptors_.size(); }
  /// Like nearest_two(), indices into the candidates, but maybe not the nearest ones; what is named has the distance
  /// that is told. With max_leaves of the candidates' number it is exact up to ties.
  [[nodiscard]] std::vector<NearestTwo> nearest_two(std::span<const Descriptor> queries) const;

 private:
  /// Inner nodes send values up to `low` left and from `high` on right. Leaves hold candidates [first, last) of order_.
  struct Node {
    std::int32_t left = -1;  ///< below 0: a leaf
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
  void descend(std::int32_t node, Search& search) const;
  void look_at(const Node& leaf, Search& search) const;

  BbfParams params_;
  Metric metric_;
  std::vector<std::uint32_t> order_;     ///< candidates' indices by leaf
  std::vector<Descriptor> descriptors_;  ///< in the order of order_
  std::vector<Node> nodes_;
};

}  // namespace seeker::vision
