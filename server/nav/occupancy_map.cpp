#include "server/nav/occupancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/assert.hpp"
#include "server/nav/ray.hpp"

namespace seeker::nav {
namespace {

constexpr double kLogOddsStep = 0.04;
constexpr int kValueLimit = 127;
constexpr std::int8_t kUnseen = -128;
constexpr int kTileShift = 6;
constexpr int kTileMask = kTileSide_cells - 1;
static_assert(1 << kTileShift == kTileSide_cells);
/// Farther from the origin no robot of ours gets; keeps cell numbers far from overflow.
constexpr double kMaxCoordinate_m = 1.0e5;
/// The echo's cell and the cell before it are not cleared: range noise would eat thin obstacles.
constexpr double kEndMargin_m = kTileResolution_m;
constexpr double kSonarEndMargin_m = 2.0 * kTileResolution_m;
constexpr double kSonarRayStep_rad = 0.035;

int quantised(double log_odds) {
  return std::clamp(static_cast<int>(std::lround(log_odds / kLogOddsStep)), -kValueLimit, kValueLimit);
}

double probability_of(std::int8_t value) { return 1.0 / (1.0 + std::exp(-kLogOddsStep * value)); }

/// Tile byte for each log-odds value, indexed by value + 128.
const std::array<std::uint8_t, 256>& byte_table() {
  static const std::array<std::uint8_t, 256> table = [] {
    std::array<std::uint8_t, 256> bytes{};
    bytes[0] = kUnknownCell;
    for (int v = -kValueLimit; v <= kValueLimit; ++v) {
      bytes[static_cast<std::size_t>(v + 128)] =
          static_cast<std::uint8_t>(std::lround(probability_of(static_cast<std::int8_t>(v)) * kOccupiedCell));
    }
    return bytes;
  }();
  return table;
}

std::uint64_t key_of(CellIndex tile) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(tile.i)) << 32U) |
         static_cast<std::uint64_t>(static_cast<std::uint32_t>(tile.j));
}

CellIndex index_of(std::uint64_t key) {
  return {static_cast<int>(static_cast<std::uint32_t>(key >> 32U)), static_cast<int>(static_cast<std::uint32_t>(key))};
}

Point2 to_cells(const Point2& p_map) { return p_map / kTileResolution_m; }

CellIndex cell_of(const Point2& p_map) { return GridFrame{Point2::Zero(), kTileResolution_m}.cell_of(p_map); }

std::size_t local_index(CellIndex cell) {
  return static_cast<std::size_t>(((cell.j & kTileMask) << kTileShift) | (cell.i & kTileMask));
}

Status check_pose(const Pose2& pose) {
  if (!is_finite(pose) || std::abs(pose.x_m) > kMaxCoordinate_m || std::abs(pose.y_m) > kMaxCoordinate_m) {
    return fail(
        Errc::kInvalidArgument,
        "the pose of a scan is not finite or over 100 km from the map's origin; the pose estimator is at fault");
  }
  return {};
}

Point2 on_beam(double range_m, double angle_rad) {
  return {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
}

bool usable(const LaserScan& scan, std::size_t beam) {
  return (scan.quality.empty() || scan.quality[beam] != 0) && scan.ranges_m[beam] >= scan.range_min_m;
}

/// How far each beam without return clears: never past the nearer of the returns on both sides of its run. A beam may
/// have got lost on a dark or grazed wall, and the wall goes on from its neighbours.
std::vector<double> no_return_clearances(const LaserScan& scan, double limit_m) {
  std::vector<double> clear_m(scan.ranges_m.size(), limit_m);
  const auto sweep = [&](std::size_t beam, double& bound_m) {
    const double range_m = scan.ranges_m[beam];
    if (usable(scan, beam) && range_m <= scan.range_max_m) {
      bound_m = range_m - kEndMargin_m;
    }
    clear_m[beam] = std::min(clear_m[beam], bound_m);
  };
  double bound_m = limit_m;
  for (std::size_t beam = 0; beam < clear_m.size(); ++beam) {
    sweep(beam, bound_m);
  }
  bound_m = limit_m;
  for (std::size_t beam = clear_m.size(); beam > 0; --beam) {
    sweep(beam - 1, bound_m);
  }
  return clear_m;
}

}  // namespace

OccupancyMap::OccupancyMap(const OccupancyParams& params) : params_(params) {
  SEEKER_ASSERT(params.log_odds_hit > 0.0 && params.log_odds_miss < 0.0 && params.max_tiles > 0);
  const int low = quantised(params.log_odds_min);
  const int high = quantised(params.log_odds_max);
  const int limit = quantised(params.sonar_log_odds_limit);
  hit_ = {std::max(1, quantised(params.log_odds_hit)), low, high, false};
  miss_ = {std::min(-1, quantised(params.log_odds_miss)), low, high, false};
  sonar_hit_ = {std::max(1, quantised(params.sonar_log_odds_hit)), -limit, limit, true};
  sonar_miss_ = {std::min(-1, quantised(params.sonar_log_odds_miss)), -limit, limit, true};
}

OccupancyMap::Tile* OccupancyMap::tile_at(CellIndex tile_index) {
  const auto found = tiles_.find(key_of(tile_index));
  if (found != tiles_.end()) {
    return found->second.get();
  }
  if (tiles_.size() >= static_cast<std::size_t>(params_.max_tiles)) {
    overflow_ = true;
    return nullptr;
  }
  auto tile = std::make_unique<Tile>();
  tile->value.fill(kUnseen);
  tile->sweep.fill(0);
  return tiles_.emplace(key_of(tile_index), std::move(tile)).first->second.get();
}

void OccupancyMap::begin_sweep() {
  overflow_ = false;
  touched_.clear();
  if (++sweep_ == 0) {  // the counter came round: old marks would look new
    for (auto& [key, tile] : tiles_) {
      tile->sweep.fill(0);
    }
    sweep_ = 1;
  }
}

Status OccupancyMap::end_sweep() {
  if (!touched_.empty()) {
    ++revision_;
  }
  for (Tile* tile : touched_) {
    tile->revision = revision_;
    tile->changed = false;
  }
  if (overflow_) {
    return fail(Errc::kTooLarge, "the occupancy map is at its limit of " + std::to_string(params_.max_tiles) +
                                     " tiles; raise nav.max_tiles or start a new map");
  }
  return {};
}

inline void OccupancyMap::write(CellIndex cell, const Evidence& evidence, Cursor& cursor) {
  const CellIndex tile_index{cell.i >> kTileShift, cell.j >> kTileShift};
  if (!cursor.valid || cursor.tile_index != tile_index) {
    cursor = {tile_index, tile_at(tile_index), true};
  }
  Tile* tile = cursor.tile;
  const std::size_t local = local_index(cell);
  if (tile == nullptr || tile->sweep[local] == sweep_) {
    return;
  }
  tile->sweep[local] = sweep_;
  const int old = tile->value[local] == kUnseen ? 0 : tile->value[local];
  if (evidence.weak && (old < evidence.low || old > evidence.high)) {
    return;
  }
  const auto value = static_cast<std::int8_t>(std::clamp(old + evidence.step, evidence.low, evidence.high));
  if (value != tile->value[local]) {
    tile->value[local] = value;
    if (!tile->changed) {
      tile->changed = true;
      touched_.push_back(tile);
    }
  }
}

void OccupancyMap::clear_ray(const Point2& from_map, const Point2& to_map, const Evidence& miss) {
  RayWalk walk(to_cells(from_map), to_cells(to_map));
  Cursor cursor;
  do {
    write(walk.cell(), miss, cursor);
  } while (walk.advance());
}

void OccupancyMap::write_hits(const LaserScan& scan, const Pose2& map_T_laser) {
  const double reach_m = std::min(params_.max_range_m, scan.range_max_m);
  Cursor cursor;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = scan.ranges_m[beam];
    if (range_m <= reach_m && usable(scan, beam)) {
      write(cell_of(map_T_laser * on_beam(range_m, scan.angle_rad(beam))), hit_, cursor);
    }
  }
}

void OccupancyMap::clear_beams(const LaserScan& scan, const Pose2& map_T_laser) {
  const std::vector<double> silent_m =
      no_return_clearances(scan, std::min(params_.no_return_clear_m, scan.range_max_m));
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = scan.ranges_m[beam];
    if (!usable(scan, beam)) {
      continue;
    }
    const double clear_m =
        range_m <= scan.range_max_m ? std::min(range_m - kEndMargin_m, params_.max_range_m) : silent_m[beam];
    if (clear_m > 0.0) {
      clear_ray(map_T_laser.translation(), map_T_laser * on_beam(clear_m, scan.angle_rad(beam)), miss_);
    }
  }
}

Status OccupancyMap::integrate(const LaserScan& scan, const Pose2& map_T_base) {
  if (auto checked = validate(scan).and_then([&] { return check_pose(map_T_base); }); !checked) {
    return checked;
  }
  const Pose2 map_T_laser = map_T_base * scan.base_T_laser;
  begin_sweep();
  write_hits(scan, map_T_laser);
  clear_beams(scan, map_T_laser);
  return end_sweep();
}

void OccupancyMap::mark_echo(const SonarReading& reading, double half_angle_rad, const Pose2& map_T_base) {
  const double range_m = reading.range_m;
  if (range_m > params_.sonar_max_range_m) {
    return;
  }
  const Pose2 map_T_sonar = map_T_base * reading.base_T_sonar;
  const double step_rad = std::min(kSonarRayStep_rad, kTileResolution_m / std::max(range_m, kTileResolution_m));
  const int rays = static_cast<int>(std::ceil(half_angle_rad / step_rad));
  Cursor cursor;
  for (int k = -rays; k <= rays; ++k) {
    const double angle_rad = rays == 0 ? 0.0 : half_angle_rad * k / rays;
    write(cell_of(map_T_sonar * on_beam(range_m, angle_rad)), sonar_hit_, cursor);
  }
}

void OccupancyMap::clear_cone(const SonarReading& reading, double half_angle_rad, const Pose2& map_T_base) {
  const double clear_m = std::min(static_cast<double>(reading.range_m) - kSonarEndMargin_m, params_.sonar_max_range_m);
  if (!std::isfinite(reading.range_m) || clear_m <= 0.0) {
    return;
  }
  const Pose2 map_T_sonar = map_T_base * reading.base_T_sonar;
  const int rays = static_cast<int>(std::ceil(half_angle_rad / kSonarRayStep_rad));
  for (int k = -rays; k <= rays; ++k) {
    const double angle_rad = rays == 0 ? 0.0 : half_angle_rad * k / rays;
    clear_ray(map_T_sonar.translation(), map_T_sonar * on_beam(clear_m, angle_rad), sonar_miss_);
  }
}

Status OccupancyMap::integrate(const SonarScan& scan, const Pose2& map_T_base) {
  if (auto checked = validate(scan).and_then([&] { return check_pose(map_T_base); }); !checked) {
    return checked;
  }
  constexpr double kMaxHalfAngle_rad = 0.8;
  const double half_angle_rad = std::clamp(scan.cone_half_angle_rad, 0.0, kMaxHalfAngle_rad);
  begin_sweep();
  for (const SonarReading& reading : scan.readings) {
    mark_echo(reading, half_angle_rad, map_T_base);
  }
  for (const SonarReading& reading : scan.readings) {
    clear_cone(reading, half_angle_rad, map_T_base);
  }
  return end_sweep();
}

std::vector<OccupancyTile> OccupancyMap::tiles_since(std::uint64_t revision) const {
  std::vector<OccupancyTile> changed;
  for (const auto& [key, tile] : tiles_) {
    if (tile->revision <= revision) {
      continue;
    }
    OccupancyTile& copy = changed.emplace_back();
    copy.index = index_of(key);
    copy.revision = tile->revision;
    for (std::size_t k = 0; k < kTileCells; ++k) {
      copy.cells[k] = byte_table()[static_cast<std::size_t>(tile->value[k] + 128)];
    }
  }
  std::sort(changed.begin(), changed.end(), [](const OccupancyTile& a, const OccupancyTile& b) {
    return a.index.j != b.index.j ? a.index.j < b.index.j : a.index.i < b.index.i;
  });
  return changed;
}

std::optional<double> OccupancyMap::probability_at(const Point2& p_map) const {
  if (!p_map.allFinite() || p_map.cwiseAbs().maxCoeff() > 2.0 * kMaxCoordinate_m) {
    return std::nullopt;
  }
  const CellIndex cell = cell_of(p_map);
  const auto found = tiles_.find(key_of({cell.i >> kTileShift, cell.j >> kTileShift}));
  if (found == tiles_.end() || found->second->value[local_index(cell)] == kUnseen) {
    return std::nullopt;
  }
  return probability_of(found->second->value[local_index(cell)]);
}

std::optional<Grid<std::uint8_t>> OccupancyMap::snapshot() const { return assemble(tiles_since(0)); }

void OccupancyMap::clear() {
  tiles_.clear();
  touched_.clear();
  ++revision_;
}

}  // namespace seeker::nav
