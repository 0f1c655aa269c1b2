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

}  // namespace

EvidenceGrid::EvidenceGrid(const EvidenceParams& params, const HitRate& rate) : params_(params), rate_(rate) {}

EvidenceGrid::Key EvidenceGrid::key_of(CellIndex cell) {
  return (static_cast<Key>(static_cast<std::uint32_t>(cell.i)) << 32U) | static_cast<std::uint32_t>(cell.j);
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

double EvidenceGrid::combined(const CellEvidence& evidence) const { return combined_with(&evidence, kNewPlace, 0.0); }

double EvidenceGrid::combined_with(const CellEvidence* evidence, std::uint32_t place, double p) const {
  double miss = 1.0;
  bool merged = false;
  if (evidence != nullptr) {
    for (const auto& [seen_from, best] : evidence->by_place) {
      const bool same = seen_from == place;
      merged = merged || same;
      miss *= 1.0 - (same ? std::max<double>(best, p) : best);
    }
  }
  if (!merged) {
    miss *= 1.0 - p;
  }
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
    CellEvidence& evidence = cells_[key_of(cell)];
    const double before = evidence.by_place.empty() ? 0.0 : combined(evidence);
    const auto seen = std::find_if(evidence.by_place.begin(), evidence.by_place.end(),
                                   [&](const auto& entry) { return entry.first == place; });
    if (seen == evidence.by_place.end()) {
      evidence.by_place.emplace_back(place, static_cast<float>(p));
    } else {
      seen->second = std::max(seen->second, static_cast<float>(p));
    }
    added += combined(evidence) - before;
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
    const auto found = cells_.find(key_of(frame().cell_of(centre)));
    const CellEvidence* evidence = found == cells_.end() ? nullptr : &found->second;
    gain += combined_with(evidence, place, p) - (evidence == nullptr ? 0.0 : combined(*evidence));
  }
  return gain;
}

double EvidenceGrid::probability(CellIndex cell) const {
  const auto found = cells_.find(key_of(cell));
  return found == cells_.end() ? 0.0 : combined(found->second);
}

void EvidenceGrid::transform(const Pose2& new_T_old) {
  const Pose2 old_T_new = inverse(new_T_old);
  std::unordered_map<Key, CellEvidence> moved;
  // Every new cell takes what the old cell under its centre had, so that rotation leaves no holes.
  for (const auto& [key, evidence] : cells_) {
    const CellIndex old{static_cast<int>(static_cast<std::uint32_t>(key >> 32U)),
                        static_cast<int>(static_cast<std::uint32_t>(key))};
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
  for (Point2& place : places_) {
    place = new_T_old * place;
  }
}

void EvidenceGrid::clear() {
  cells_.clear();
  places_.clear();
}

}  // namespace seeker::search
