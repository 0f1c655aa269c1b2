#include "server/search/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/nav/visibility.hpp"

namespace seeker::search {
namespace {

constexpr std::uint32_t kNewPlace = std::numeric_limits<std::uint32_t>::max();

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

/// Calls f(cell) for each cell of `frame` once whose centre may lie in a grid.
template <class F>
void for_each_cell_under(const Grid<std::uint8_t>& grid, const Pose2& map_T_grid, const GridFrame& frame, F&& f) {
  const GridFrame& theirs = grid.frame();
  Point2 low = map_T_grid * theirs.origin;
  Point2 high = low;
  for (const CellIndex corner : {CellIndex{grid.width(), 0}, {0, grid.height()}, {grid.width(), grid.height()}}) {
    const Point2 p = map_T_grid * Point2(theirs.origin + theirs.resolution_m * Point2(corner.i, corner.j));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const CellIndex first = frame.cell_of(low);
  const CellIndex last = frame.cell_of(high);
  for (CellIndex cell = first; cell.j <= last.j; ++cell.j) {
    for (cell.i = first.i; cell.i <= last.i; ++cell.i) {
      f(cell);
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
  const auto others = others_miss_.find(key);
  const double miss = others == others_miss_.end() ? own : own * others->second;
  return std::min(1.0 - miss, params_.max_probability);
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

void EvidenceGrid::set_others(const std::vector<SearchedFloor>& others) {
  constexpr double kScale = 254.0;
  others_miss_.clear();
  for (const SearchedFloor& other : others) {
    const GridFrame& theirs = other.probability.frame();
    if (theirs.resolution_m != params_.cell_m) {
      continue;
    }
    const Pose2 grid_T_map = inverse(other.map_T_grid);
    for_each_cell_under(other.probability, other.map_T_grid, frame(), [&](CellIndex cell) {
      const CellIndex under = theirs.cell_of(grid_T_map * frame().centre_of(cell));
      const double seen = other.probability.contains(under) ? other.probability[under] / kScale : 0.0;
      if (seen > 0.0) {
        others_miss_.try_emplace(key_of(cell), 1.0).first->second *= 1.0 - std::min(seen, 1.0);
      }
    });
  }
}

Grid<std::uint8_t> EvidenceGrid::own_looks(const Point2& middle_map, int side_cells) const {
  constexpr double kScale = 254.0;
  const CellIndex middle = frame().cell_of(middle_map);
  const CellIndex low{middle.i - side_cells / 2, middle.j - side_cells / 2};
  const CellIndex high{low.i + side_cells, low.j + side_cells};
  const auto inside = [&](CellIndex c) { return c.i >= low.i && c.j >= low.j && c.i < high.i && c.j < high.j; };
  CellIndex first = high;
  CellIndex last = low;
  for (const auto& [key, evidence] : cells_) {
    if (const CellIndex c = cell_of(key); inside(c)) {
      first = {std::min(first.i, c.i), std::min(first.j, c.j)};
      last = {std::max(last.i, c.i), std::max(last.j, c.j)};
    }
  }
  if (first.i > last.i || first.j > last.j) {
    return {};
  }
  const GridFrame own{params_.cell_m * Point2(first.i, first.j), params_.cell_m};
  Grid<std::uint8_t> looks(own, last.i - first.i + 1, last.j - first.j + 1, 0);
  for (const auto& [key, evidence] : cells_) {
    if (const CellIndex c = cell_of(key); inside(c)) {
      const double seen = std::min(1.0 - miss_of(evidence, kNewPlace, 0.0), params_.max_probability);
      looks[{c.i - first.i, c.j - first.j}] = static_cast<std::uint8_t>(std::lround(seen * kScale));
    }
  }
  return looks;
}

void EvidenceGrid::transform(const Pose2& new_T_old) {
  const Pose2 old_T_new = inverse(new_T_old);
  std::unordered_map<Key, CellEvidence> moved;
  // Every new cell takes what the old cell under its centre had, so that rotation leaves no holes.
  for (const auto& [key, evidence] : cells_) {
    const CellIndex old = cell_of(key);
    const CellIndex about = frame().cell_of(new_T_old * frame().centre_of(old));
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex cell{about.i + di, about.j + dj};
        if (frame().cell_of(old_T_new * frame().centre_of(cell)) == old) {
          moved[key_of(cell)] = evidence;
        }
      }
    }
  }
  cells_ = std::move(moved);
  others_miss_.clear();
  for (Point2& place : places_) {
    place = new_T_old * place;
  }
}

void EvidenceGrid::clear() {
  cells_.clear();
  places_.clear();
  others_miss_.clear();
}

}  // namespace seeker::search
