#include "server/slam/global_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

constexpr double kFull = 255.0;
constexpr std::size_t kMaxPoints = 250;  ///< their sum fits into 16 bits

/// A point rotated to one heading, in whole cells from the base.
struct RotatedPoint {
  int i;
  int j;
  int direction;
};

/// Poses with one heading: block (0, 0) of the top level begins at cell `first`.
struct Heading {
  double theta_rad;
  std::vector<RotatedPoint> points;
};

struct Block {
  int bound;
  int heading;
  int i;  ///< first cell of the base
  int j;
};

/// Where the base may be, in cells of the map.
struct Range {
  CellIndex first;
  int columns;  ///< blocks of the top level
  int rows;
  double first_rad;
  double step_rad;
  int headings;
};

double far_distance_m(const std::vector<OrientedPoint>& points, double quantile) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const OrientedPoint& point : points) {
    distances.push_back(point.p.norm());
  }
  const auto at = static_cast<std::size_t>(quantile * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(at), distances.end());
  return distances[at];
}

Range range_of(const LikelihoodPyramid& map, const std::optional<SearchWindow>& window, double step_rad) {
  const int block = 1 << map.coarse_level();
  if (!window) {
    const int headings = static_cast<int>(std::ceil(kTwoPi / step_rad));
    return {{0, 0}, map.width() / block, map.height() / block, -kPi, kTwoPi / headings, headings};
  }
  const Point2 half = Point2::Constant(window->half_m);
  const CellIndex low = map.frame().cell_of(window->map_T_base.translation() - half);
  const CellIndex high = map.frame().cell_of(window->map_T_base.translation() + half);
  const int turns = static_cast<int>(std::ceil(std::min(window->half_rad, kPi) / step_rad));
  return {low,
          (high.i - low.i) / block + 1,
          (high.j - low.j) / block + 1,
          window->map_T_base.theta_rad - turns * step_rad,
          step_rad,
          2 * turns + 1};
}

/// Below the top in any case.
int leaf_level_of(const LikelihoodPyramid& map, const GlobalSearchParams& params) {
  return std::clamp(params.leaf_level, 0, map.coarse_level() - 1);
}

/// One search: the state that its recursion shares.
class Search {
 public:
  Search(const LikelihoodPyramid& map, const std::vector<OrientedPoint>& points, const Range& range,
         const GlobalSearchParams& params, GlobalSearchResult& result)
      : map_(map), params_(params), range_(range), result_(result), full_(kFull * static_cast<double>(points.size())) {
    leaf_level_ = leaf_level_of(map, params);
    headings_.reserve(static_cast<std::size_t>(range.headings));
    for (int k = 0; k < range.headings; ++k) {
      headings_.push_back(turned(points, wrap_angle(range.first_rad + k * range.step_rad)));
    }
    raise_threshold();
  }

  void run() {
    for (const Block& block : blocks()) {
      if (block.bound <= threshold_ || !result_.complete) {
        break;
      }
      expand(block, map_.coarse_level());
    }
  }

 private:
  [[nodiscard]] Heading turned(const std::vector<OrientedPoint>& points, double theta_rad) const {
    Heading heading{theta_rad, {}};
    heading.points.reserve(points.size());
    const Pose2 rotation{0.0, 0.0, theta_rad};
    const double cell_m = map_.frame().resolution_m;
    for (const OrientedPoint& point : points) {
      const Point2 p = rotation * point.p;
      const double normal_rad = std::atan2(point.normal.y(), point.normal.x()) + theta_rad;
      // The base stands in the middle of its cell.
      heading.points.push_back({static_cast<int>(std::floor(p.x() / cell_m + 0.5)),
                                static_cast<int>(std::floor(p.y() / cell_m + 0.5)), map_.direction_of(normal_rad)});
    }
    return heading;
  }

  /// The blocks of the top level worth a look, best first.
  [[nodiscard]] std::vector<Block> blocks() {
    const int size = 1 << map_.coarse_level();
    std::vector<Block> found;
    LikelihoodPyramid::BlockSums sums(range_.columns, range_.rows);
    for (int heading = 0; heading < range_.headings; ++heading) {
      std::fill(sums.sums.begin(), sums.sums.end(), std::uint16_t{0});
      for (const RotatedPoint& point : headings_[static_cast<std::size_t>(heading)].points) {
        map_.add_blocks(point.direction, {range_.first.i + point.i, range_.first.j + point.j}, sums);
      }
      for (int row = 0; row < range_.rows; ++row) {
        for (int column = 0; column < range_.columns; ++column) {
          if (sums.at(column, row) > threshold_) {
            found.push_back(
                {sums.at(column, row), heading, range_.first.i + column * size, range_.first.j + row * size});
          }
        }
      }
    }
    std::sort(found.begin(), found.end(), [](const Block& a, const Block& b) {
      return std::tie(b.bound, a.heading, a.j, a.i) < std::tie(a.bound, b.heading, b.j, b.i);
    });
    return found;
  }

  /// Sum of the level's maxima; gives up, with a sum at or below the threshold, when it cannot get above it.
  [[nodiscard]] int bound_of(const Block& block, int level) const {
    const std::vector<RotatedPoint>& points = headings_[static_cast<std::size_t>(block.heading)].points;
    constexpr std::size_t kStride = 16;
    int sum = 0;
    for (std::size_t begin = 0; begin < points.size(); begin += kStride) {
      const std::size_t end = std::min(points.size(), begin + kStride);
      for (std::size_t k = begin; k < end; ++k) {
        sum += map_.value(level, points[k].direction, block.i + points[k].i, block.j + points[k].j);
      }
      if (sum + static_cast<int>(kFull) * static_cast<int>(points.size() - end) <= threshold_) {
        return 0;
      }
    }
    return sum;
  }

  void expand(const Block& block, int level) {
    if (block.bound <= threshold_ || explained(block, level)) {
      return;
    }
    if (level == leaf_level_) {
      offer(block);
      return;
    }
    const int half = 1 << (level - 1);
    std::array<Block, 4> children{};
    for (int k = 0; k < 4; ++k) {
      Block& child = children[static_cast<std::size_t>(k)];
      child = {0, block.heading, block.i + half * (k % 2), block.j + half * (k / 2)};
      child.bound = bound_of(child, level - 1);
    }
    result_.expansions += children.size();
    if (result_.expansions > params_.max_expansions) {
      result_.complete = false;
      return;
    }
    std::stable_sort(children.begin(), children.end(),
                     [](const Block& a, const Block& b) { return a.bound > b.bound; });
    for (const Block& child : children) {
      expand(child, level - 1);
    }
  }

  [[nodiscard]] Pose2 centre_of(const Block& block, int level) const {
    const double half = 0.5 * ((1 << level) - 1);
    const Point2 p = map_.frame().centre_of({block.i, block.j}) + map_.frame().resolution_m * Point2(half, half);
    return {p.x(), p.y(), headings_[static_cast<std::size_t>(block.heading)].theta_rad};
  }

  [[nodiscard]] bool same_place(const Pose2& a, const Pose2& b, double slack_m) const {
    return distance_m(a, b) + slack_m <= params_.distinct_m &&
           std::abs(wrap_angle(a.theta_rad - b.theta_rad)) <= params_.distinct_rad;
  }

  /// Nothing in the block can be anything but a worse neighbour of what was found.
  [[nodiscard]] bool explained(const Block& block, int level) const {
    const Pose2 centre = centre_of(block, level);
    const double slack_m = std::sqrt(0.5) * ((1 << level) - 1) * map_.frame().resolution_m;
    return std::any_of(result_.candidates.begin(), result_.candidates.end(), [&](const GlobalCandidate& candidate) {
      return candidate.score * full_ >= block.bound && same_place(candidate.map_T_base, centre, slack_m);
    });
  }

  void offer(const Block& leaf) {
    const GlobalCandidate found{centre_of(leaf, leaf_level_), leaf.bound / full_};
    std::vector<GlobalCandidate>& list = result_.candidates;
    const auto near = [&](const GlobalCandidate& other) { return same_place(other.map_T_base, found.map_T_base, 0.0); };
    if (std::any_of(list.begin(), list.end(),
                    [&](const GlobalCandidate& other) { return near(other) && other.score >= found.score; })) {
      return;
    }
    list.erase(std::remove_if(list.begin(), list.end(), near), list.end());
    const auto place =
        std::find_if(list.begin(), list.end(), [&](const GlobalCandidate& other) { return other.score < found.score; });
    list.insert(place, found);
    const double limit = params_.rival_ratio * list.front().score;
    while (list.size() > params_.max_candidates || list.back().score < limit) {
      list.pop_back();
    }
    raise_threshold();
  }

  void raise_threshold() {
    double score = params_.min_score;
    if (!result_.candidates.empty()) {
      score = std::max(score, params_.rival_ratio * result_.candidates.front().score);
    }
    if (result_.candidates.size() == params_.max_candidates) {
      score = std::max(score, result_.candidates.back().score);
    }
    threshold_ = static_cast<int>(score * full_);
  }

  const LikelihoodPyramid& map_;
  const GlobalSearchParams& params_;
  Range range_;
  GlobalSearchResult& result_;
  double full_;  ///< sum of a perfect fit
  int threshold_ = 0;
  int leaf_level_ = 0;
  std::vector<Heading> headings_;
};

}  // namespace

std::vector<OrientedPoint> thin_by_cells(const std::vector<OrientedPoint>& points, double cell_m, std::size_t limit) {
  constexpr double kDirections = 8.0;
  std::set<std::tuple<long, long, long>> taken;
  std::vector<OrientedPoint> kept;
  for (const OrientedPoint& point : points) {
    const double normal_rad = std::atan2(point.normal.y(), point.normal.x());
    const auto direction = std::lround(normal_rad / kTwoPi * kDirections) % static_cast<long>(kDirections);
    if (taken.emplace(std::lround(point.p.x() / cell_m), std::lround(point.p.y() / cell_m), direction).second) {
      kept.push_back(point);
    }
  }
  return thin_out(kept, limit);
}

GlobalSearchResult GlobalMatcher::search(const LikelihoodPyramid& map, const std::vector<OrientedPoint>& points_base,
                                         const std::optional<SearchWindow>& window) const {
  const std::vector<OrientedPoint> points =
      thin_by_cells(points_base, params_.thin_cell_m, std::min(params_.max_points, kMaxPoints));
  GlobalSearchResult result;
  result.points = points.size();
  if (points.empty()) {
    return result;
  }
  const double leaf_m = (1 << leaf_level_of(map, params_)) * map.frame().resolution_m;
  const double far_m = std::max(far_distance_m(points, params_.far_quantile), leaf_m);
  const double step_rad = std::clamp(leaf_m / far_m, params_.min_step_rad, params_.max_step_rad);
  Search(map, points, range_of(map, window, step_rad), params_, result).run();
  return result;
}

}  // namespace seeker::slam
