#include "server/search/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "server/nav/visibility.hpp"

namespace seeker::search {
namespace {

constexpr std::uint32_t kNewPlace = std::numeric_limits<std::uint32_t>::max();
/// Observations of an earlier run, from all its places; no robot is ever there.
constexpr std::uint32_t kEarlierPlace = kNewPlace - 1;
constexpr double kProbabilityScale = 254.0;  // of SearchedFloor::probability

/// Calls f(cell, probability) for every cell that one look from `camera_map` can show.
template <class F>
void for_each_seen(const Grid<std::uint8_t>& occupancy, const GridFrame& frame, const Point2& camera_map,
                   const HitRate& rate, double target_size_m, F&& f) {
  const CellIndex low = frame.cell_of(camera_map - Point2::Constant(rate.max_range_m));
  const CellIndex high = frame.cell_of(camera_map + Point2::Constant(rate.max_range_m));
  for (CellIndex cell = low; cell.j <= high.j; ++cell.j) {
    for (cell.i = low.i; cell.i <= high.i; ++cell.i) {
      const Point2 centre = frame.centre_of(cell);
      const double p = rate.probability((centre - camera_map).norm(), target_size_m);
      if (p > 0.0 && nav::line_of_sight(occupancy, camera_map, centre)) {
        f(cell, p);
      }
    }
  }
}

}  // namespace

EvidenceGrid::EvidenceGrid(const EvidenceParams& params, const HitRate& rate) : params_(params), rate_(rate) {}

EvidenceGrid::Key EvidenceGrid::key_of(CellIndex cell) {
  return (static_cast<Key>(static_cast<std::uint32_t>(cell.i)) << 32U) | static_cast<std::uint32_t>(cell.j);
}

CellIndex EvidenceGrid::cell_of(Key key) {
  return {static_cast<int>(static_cast<std::uint32_t>(key >> 32U)), static_cast<int>(static_cast<std::uint32_t>(key))};
}

std::uint32_t EvidenceGrid::place_of(const Point2& camera_map) const {
  std::uint32_t nearest = kNewPlace;
  double nearest_m = params_.independent_after_m;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const double distance = (places_[k] - camera_map).norm();
    if (distance < nearest_m) {
      nearest_m = distance;
      nearest = static_cast<std::uint32_t>(k);
    }
  }
  return nearest;
}

double EvidenceGrid::miss_of(const CellEvidence& evidence, std::uint32_t place, double p) {
  double miss = 1.0;
  bool merged = false;
  for (const auto& [seen_from, best] : evidence.by_place) {
    const bool same = seen_from == place;
    merged = merged || same;
    miss *= 1.0 - (same ? std::max<double>(best, p) : best);
  }
  return merged ? miss : miss * (1.0 - p);
}

double EvidenceGrid::combined(Key key, const CellEvidence* evidence) const {
  return combined_with(key, evidence, kNewPlace, 0.0);
}

double EvidenceGrid::combined_with(Key key, const CellEvidence* evidence, std::uint32_t place, double p) const {
  const double own = evidence != nullptr ? miss_of(*evidence, place, p) : 1.0 - p;
  return std::min(1.0 - own * others_miss(cell_of(key)), params_.max_probability);
}

double EvidenceGrid::add_look(const Grid<std::uint8_t>& occupancy, const Point2& camera_map, double target_size_m) {
  std::uint32_t place = place_of(camera_map);
  if (place == kNewPlace) {
    place = static_cast<std::uint32_t>(places_.size());
    places_.push_back(camera_map);
  }
  double added = 0.0;
  for_each_seen(occupancy, frame(), camera_map, rate_, target_size_m, [&](CellIndex cell, double p) {
    const Key key = key_of(cell);
    CellEvidence& evidence = cells_[key];
    const double before = combined(key, &evidence);
    const auto seen = std::find_if(evidence.by_place.begin(), evidence.by_place.end(),
                                   [&](const auto& entry) { return entry.first == place; });
    if (seen == evidence.by_place.end()) {
      evidence.by_place.emplace_back(place, static_cast<float>(p));
    } else {
      seen->second = std::max(seen->second, static_cast<float>(p));
    }
    added += combined(key, &evidence) - before;
  });
  return added;
}

double EvidenceGrid::expected_gain(const Grid<std::uint8_t>& occupancy, const Grid<std::uint8_t>& wanted,
                                   const Point2& camera_map, double target_size_m) const {
  const std::uint32_t place = place_of(camera_map);
  double gain = 0.0;
  for (const CellIndex local : nav::visible_cells_of(wanted, occupancy, camera_map, rate_.max_range_m)) {
    const Point2 centre = wanted.frame().centre_of(local);
    const double p = rate_.probability((centre - camera_map).norm(), target_size_m);
    if (p <= 0.0) {
      continue;
    }
    const Key key = key_of(frame().cell_of(centre));
    const auto found = cells_.find(key);
    const CellEvidence* evidence = found == cells_.end() ? nullptr : &found->second;
    gain += combined_with(key, evidence, place, p) - combined(key, evidence);
  }
  return gain;
}

double EvidenceGrid::probability(CellIndex cell) const {
  const auto found = cells_.find(key_of(cell));
  return combined(key_of(cell), found == cells_.end() ? nullptr : &found->second);
}

EvidenceGrid::Other EvidenceGrid::other_from(SearchedFloor floor) {
  const Pose2 grid_T_map = inverse(floor.map_T_grid);
  const Matrix2 grid_R_map = Eigen::Rotation2Dd(grid_T_map.theta_rad).toRotationMatrix();
  return {std::move(floor), grid_R_map, grid_T_map.translation()};
}

void EvidenceGrid::set_others(const std::vector<SearchedFloor>& others) {
  others_.clear();
  for (const SearchedFloor& other : others) {
    if (other.probability && other.probability->frame().resolution_m == params_.cell_m) {
      others_.push_back(other_from(other));
    }
  }
}

double EvidenceGrid::others_miss(CellIndex cell) const {
  double miss = 1.0;
  const Point2 centre = frame().centre_of(cell);
  for (const Other& other : others_) {
    const Grid<std::uint8_t>& grid = *other.floor.probability;
    const CellIndex under = grid.frame().cell_of(other.grid_R_map * centre + other.grid_t_map);
    if (grid.contains(under)) {
      miss *= 1.0 - std::min(grid[under] / kProbabilityScale, 1.0);
    }
  }
  return miss;
}

EvidenceGrid::CellBox EvidenceGrid::box_of_looks(const CellBox& within) const {
  CellBox box{within.last, within.first};
  bool any = false;
  for (const auto& [key, evidence] : cells_) {
    if (const CellIndex c = cell_of(key); within.contains(c)) {
      box.first = {std::min(box.first.i, c.i), std::min(box.first.j, c.j)};
      box.last = {std::max(box.last.i, c.i), std::max(box.last.j, c.j)};
      any = true;
    }
  }
  return any ? box : CellBox{{0, 0}, {-1, -1}};
}

void EvidenceGrid::take_back(const Grid<std::uint8_t>& looks) {
  if (looks.frame().resolution_m != params_.cell_m) {
    return;
  }
  for (std::size_t k = 0; k < looks.cells().size(); ++k) {
    if (looks.cells()[k] != 0) {
      const double p = std::min(looks.cells()[k] / kProbabilityScale, params_.max_probability);
      const CellIndex cell = frame().cell_of(looks.frame().centre_of(looks.cell(k)));
      cells_[key_of(cell)].by_place.emplace_back(kEarlierPlace, static_cast<float>(p));
    }
  }
}

Grid<std::uint8_t> EvidenceGrid::own_looks(const Point2& middle_map, int side_cells) const {
  constexpr int kLowest = std::numeric_limits<int>::min();
  constexpr int kHighest = std::numeric_limits<int>::max();
  CellBox box = box_of_looks({{kLowest, kLowest}, {kHighest, kHighest}});
  const auto too_long = [side_cells](int first, int last) { return std::int64_t{last} - first >= side_cells; };
  if (too_long(box.first.i, box.last.i) || too_long(box.first.j, box.last.j)) {
    const CellIndex middle = frame().cell_of(middle_map);
    const CellIndex low{middle.i - side_cells / 2, middle.j - side_cells / 2};
    box = box_of_looks({low, {low.i + side_cells - 1, low.j + side_cells - 1}});
  }
  const GridFrame own{params_.cell_m * Point2(box.first.i, box.first.j), params_.cell_m};
  Grid<std::uint8_t> looks(own, box.last.i - box.first.i + 1, box.last.j - box.first.j + 1, 0);
  for (const auto& [key, evidence] : cells_) {
    if (const CellIndex c = cell_of(key); box.contains(c)) {
      const double seen = std::min(1.0 - miss_of(evidence, kNewPlace, 0.0), params_.max_probability);
      looks[{c.i - box.first.i, c.j - box.first.j}] = static_cast<std::uint8_t>(std::lround(seen * kProbabilityScale));
    }
  }
  return looks;
}

void EvidenceGrid::transform(const MapMove& move) {
  const MapMove back = inverse(move);
  std::unordered_map<Key, CellEvidence> moved;
  // Every new cell takes what the old cell under its centre had, so that rotation leaves no holes.
  for (const auto& [key, evidence] : cells_) {
    const CellIndex old = cell_of(key);
    const CellIndex about = frame().cell_of(move * frame().centre_of(old));
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex cell{about.i + di, about.j + dj};
        if (frame().cell_of(back * frame().centre_of(cell)) == old) {
          moved[key_of(cell)] = evidence;
        }
      }
    }
  }
  cells_ = std::move(moved);
  for (Other& other : others_) {
    other.floor.map_T_grid = move * other.floor.map_T_grid;
    other = other_from(std::move(other.floor));
  }
  for (Point2& place : places_) {
    place = move * place;
  }
}

void EvidenceGrid::clear() {
  cells_.clear();
  places_.clear();
  others_.clear();
}

}  // namespace seeker::search
