#include "server/explore/coarse_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "server/tour/nearest_cell.hpp"

namespace seeker::explore {
namespace {

constexpr std::size_t kSides = 4;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kNoFloor = -1.0F;  ///< shorter than any path, so that no search enters

}  // namespace

CoarsePaths::CoarsePaths(const Grid<std::uint8_t>& floor)
    : floor_(floor),
      unreached_(static_cast<std::size_t>(floor.width() + 2) * static_cast<std::size_t>(floor.height() + 2), kNoFloor) {
  for (std::size_t k = 0; k < floor.cells().size(); ++k) {
    if (floor.cells()[k] != 0) {
      unreached_[node_of(floor.cell(k))] = kFar;
    }
  }
  const int row = floor.width() + 2;
  beside_ = {1, -1, row, -row, row + 1, row - 1, 1 - row, -row - 1};
}

CoarsePaths::Node CoarsePaths::node_of(CellIndex cell) const {
  return static_cast<Node>(cell.j + 1) * static_cast<Node>(floor_.width() + 2) + static_cast<Node>(cell.i + 1);
}

/// Dijkstra whose queue are buckets one cell wide: no step is shorter, so that all of a bucket is final when the search
/// comes to it, and none is longer than two, so that three buckets are enough.
std::vector<float> CoarsePaths::spread(Node start, std::vector<Node> targets) const {
  std::vector<float> lengths = unreached_;
  std::array<std::vector<Node>, 3> buckets;
  lengths[start] = 0.0F;
  buckets[0].push_back(start);
  for (std::size_t at = 0; !targets.empty(); ++at) {
    std::vector<Node>& now = buckets[at % buckets.size()];
    for (const Node node : now) {
      if (static_cast<std::size_t>(lengths[node]) != at) {
        continue;  // a shorter path was found after this entry was queued
      }
      for (std::size_t d = 0; d < kDirections; ++d) {
        const Node next = node + static_cast<Node>(beside_[d]);
        const float longer = lengths[node] + (d < kSides ? 1.0F : std::numbers::sqrt2_v<float>);
        if (longer < lengths[next]) {
          lengths[next] = longer;
          buckets[static_cast<std::size_t>(longer) % buckets.size()].push_back(next);
        }
      }
    }
    now.clear();
    std::erase_if(targets, [&](Node target) { return lengths[target] < static_cast<float>(at + 1); });
    if (std::all_of(buckets.begin(), buckets.end(), [](const auto& bucket) { return bucket.empty(); })) {
      break;
    }
  }
  return lengths;
}

std::optional<CoarsePaths::Node> CoarsePaths::node_at(const Point2& p_map) const {
  const auto cell = tour::nearest_cell(floor_, p_map);
  return cell ? std::optional(node_of(*cell)) : std::nullopt;
}

std::vector<double> CoarsePaths::lengths_m(const Point2& from_map, std::span<const Point2> to_map) const {
  std::vector<double> lengths(to_map.size(), kNoPath);
  const auto start = node_at(from_map);
  if (!start) {
    return lengths;
  }
  std::vector<std::optional<Node>> nodes;
  std::vector<Node> targets;
  nodes.reserve(to_map.size());
  targets.reserve(to_map.size());
  for (const Point2& p : to_map) {
    nodes.push_back(node_at(p));
    if (nodes.back()) {
      targets.push_back(*nodes.back());
    }
  }
  const std::vector<float> reached = spread(*start, std::move(targets));
  for (std::size_t k = 0; k < to_map.size(); ++k) {
    if (nodes[k]) {
      // Two places in one cell are still apart.
      const double path_m = floor_.frame().resolution_m * static_cast<double>(reached[*nodes[k]]);
      lengths[k] = std::max(path_m, (to_map[k] - from_map).norm());
    }
  }
  return lengths;
}

std::vector<double> CoarsePaths::expected_m(const Point2& from_map, std::span<const Point2> to_map) const {
  constexpr double kDetour = 1.5;  ///< of the straight line
  std::vector<double> lengths = lengths_m(from_map, to_map);
  for (std::size_t k = 0; k < to_map.size(); ++k) {
    if (!std::isfinite(lengths[k])) {
      lengths[k] = kDetour * (to_map[k] - from_map).norm();
    }
  }
  return lengths;
}

}  // namespace seeker::explore
