#include "server/explore/openings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"
#include "server/nav/visibility.hpp"

namespace seeker::explore {
namespace {

/// Half of what the robot's sensors see, less a margin.
constexpr double kViewHalfAngle_rad = deg_to_rad(80.0);
/// A wall seen flatter than this gives no line worth the name.
constexpr double kFlat_rad = deg_to_rad(12.0);
/// Angles at which a viewpoint may lie off the perpendicular of the observed side.
constexpr std::array<double, 7> kViewAngles_deg{0.0, 25.0, -25.0, 50.0, -50.0, 65.0, -65.0};
/// Beside a wall the floor in front of it is observed, because the wall's own cells are occupied.
constexpr double kOffWall_m = 0.15;
/// After a correction of the map openings are looked for about where they were, for so long and no farther than this.
constexpr double kSettle_s = 10.0;
constexpr double kMostSlack_m = 1.0;

bool unknown_near(const Grid<std::uint8_t>& occupancy, const Point2& p_map, double radius_m) {
  const GridFrame& frame = occupancy.frame();
  const CellIndex centre = frame.cell_of(p_map);
  const int reach = static_cast<int>(std::ceil(radius_m / frame.resolution_m));
  for (CellIndex cell{centre.i - reach, centre.j - reach}; cell.j <= centre.j + reach; ++cell.j) {
    for (cell.i = centre.i - reach; cell.i <= centre.i + reach; ++cell.i) {
      const bool known = occupancy.contains(cell) && occupancy[cell] != kUnknownCell;
      if (!known && (frame.centre_of(cell) - p_map).norm() <= radius_m) {
        return true;
      }
    }
  }
  return false;
}

std::string text_of(OpeningKind kind) {
  const std::string no_drive = "no drive came to a place that shows ";
  switch (kind) {
    case OpeningKind::kFrontier: return no_drive + "what lies behind the border of unknown floor";
    case OpeningKind::kWallEnd: return no_drive + "how far the wall goes on";
    case OpeningKind::kWallFace: break;
  }
  return no_drive + "this side of the wall";
}

}  // namespace

Openings::Openings(const ViewpointParams& params) : params_(params) {}

std::vector<Opening> Openings::find(const OpeningsInput& input) {
  now_ = input.now;
  if (std::exchange(moved_, false)) {
    moved_at_ = now_;
  }
  std::vector<Opening> all = frontier_openings(input, params_);
  if (input.walls) {
    const std::vector<Opening> ends = wall_end_openings(input, params_);
    all.insert(all.end(), ends.begin(), ends.end());
    const std::vector<Opening> faces = wall_face_openings(input, params_);
    all.insert(all.end(), faces.begin(), faces.end());
  }
  std::vector<Opening> open;
  open.reserve(all.size());
  for (Opening& opening : all) {
    if (is_open(opening, input)) {
      open.push_back(opening);
    }
  }
  for (Memory& memory : memories_) {
    memory.gone = memory.failures >= params_.max_failures && !still_there(memory, input);
  }
  std::stable_sort(open.begin(), open.end(), [](const Opening& a, const Opening& b) { return a.cost < b.cost; });
  return open;
}

bool Openings::still_there(const Memory& memory, const OpeningsInput& input) const {
  switch (memory.kind) {
    case OpeningKind::kFrontier: return unknown_near(input.floor.occupancy, memory.p_map, params_.reached_m);
    case OpeningKind::kWallEnd:
      return std::any_of(input.segments.begin(), input.segments.end(), [&](const MapSegment& wall) {
        return (!wall.left_real && (wall.left() - memory.p_map).norm() < params_.same_m) ||
               (!wall.right_real && (wall.right() - memory.p_map).norm() < params_.same_m);
      });
    case OpeningKind::kWallFace: break;  // reported until it was observed: the cells of its face are not kept
  }
  return true;
}

bool Openings::is_open(Opening& opening, const OpeningsInput& input) {
  Memory& memory = memory_of(opening);
  memory.size_m = opening.size_m;
  const bool near_enough = opening.kind != OpeningKind::kFrontier ||
                           (opening.p_map - input.map_T_base.translation()).norm() < params_.reached_m;
  if (near_enough && well_in_view(opening, input.map_T_base, input.floor.occupancy, params_)) {
    count_look(memory, input.now);
  }
  opening.id = memory.id;
  opening.visits = memory.visits;
  opening.resting = std::any_of(memories_.begin(), memories_.end(), [&](const Memory& other) {
    return other.failures > 0 && to_seconds(input.now - other.failed_at) < params_.retry_s &&
           (other.p_map - opening.p_map).norm() < params_.failed_radius_m;
  });
  return memory.visits < params_.max_visits && memory.failures < params_.max_failures;
}

bool Openings::is_settling() const { return moved_ || to_seconds(now_ - moved_at_) < kSettle_s; }

Openings::Memory& Openings::memory_of(const Opening& opening) {
  const bool settling = is_settling();
  Memory* nearest = nullptr;
  double nearest_m = params_.same_m + kMostSlack_m;
  for (Memory& memory : memories_) {
    const bool other_side = opening.kind == OpeningKind::kWallFace && memory.outward_map.dot(opening.outward_map) < 0.0;
    const double d = (memory.p_map - opening.p_map).norm();
    const double reach_m = params_.same_m + (settling ? memory.slack_m : 0.0);
    if (memory.kind == opening.kind && !other_side && d < std::min(nearest_m, reach_m)) {
      nearest = &memory;
      nearest_m = d;
    }
  }
  if (nearest != nullptr) {
    if (settling && nearest->slack_m > 0.0) {
      nearest->p_map = opening.p_map;
    }
    return *nearest;
  }
  Memory& memory = memories_.emplace_back();
  memory.id = next_id_++;
  memory.kind = opening.kind;
  memory.p_map = opening.p_map;
  memory.outward_map = opening.outward_map;
  return memory;
}

void Openings::count_look(Memory& memory, RobotTime now) const {
  if (memory.visits == 0 || to_seconds(now - memory.looked_at) >= params_.look_s) {
    ++memory.visits;
    memory.looked_at = now;
  }
}

void Openings::looked(const Opening& opening, RobotTime now) { count_look(memory_of(opening), now); }

void Openings::failed(const Opening& opening, RobotTime now) {
  Memory& memory = memory_of(opening);
  ++memory.failures;
  memory.failed_at = now;
}

void Openings::try_again() {
  for (Memory& memory : memories_) {
    if (memory.failures >= params_.max_failures) {
      memory.failures = params_.max_failures - 1;
      memory.failed_at = now_ - seconds(params_.retry_s);
    }
  }
}

std::vector<UnreachablePlace> Openings::given_up() const {
  std::vector<UnreachablePlace> places;
  for (const Memory& memory : memories_) {
    if (memory.failures >= params_.max_failures && memory.visits < params_.max_visits && !memory.gone) {
      places.push_back({memory.p_map, UnreachableCause::kBlocked, memory.size_m, text_of(memory.kind)});
    }
  }
  return places;
}

void Openings::transform(const MapMove& move) {
  const bool settling = is_settling();
  moved_ = true;
  for (Memory& memory : memories_) {
    const Pose2 new_T_old = move.at(memory.p_map);
    const Point2 p_map = new_T_old * memory.p_map;
    memory.slack_m = std::min((settling ? memory.slack_m : 0.0) + (p_map - memory.p_map).norm(), kMostSlack_m);
    memory.outward_map = new_T_old * Point2(memory.p_map + memory.outward_map) - p_map;
    memory.p_map = p_map;
  }
}

std::string describe(const Opening& opening) {
  switch (opening.kind) {
    case OpeningKind::kFrontier: return "the border of unknown floor (" + text(opening.size_m) + " m)";
    case OpeningKind::kWallFace: return "the unseen side of a wall (" + text(opening.size_m) + " m)";
    case OpeningKind::kWallEnd: break;
  }
  return "the end of wall " + std::to_string(opening.segment);
}

bool well_in_view(const Opening& opening, const Pose2& map_T_base, const Grid<std::uint8_t>& occupancy,
                  const ViewpointParams& params) {
  const Point2 eye = map_T_base.translation();
  const bool wall = opening.kind == OpeningKind::kWallEnd;
  if ((opening.p_map - eye).norm() > params.view_range_m) {
    return false;
  }
  // What counts is what lies behind: the floor beyond a border, the place into which a wall would go on.
  const Point2 target = opening.p_map + (wall ? params.min_extension_m : params.reached_m) * opening.outward_map;
  if (std::abs(bearing_to(map_T_base, target)) > kViewHalfAngle_rad) {
    return false;
  }
  nav::VisibilityParams sight;
  sight.unknown_blocks = false;
  const double steepness = opening.outward_map.dot((opening.p_map - eye).normalized());
  if (opening.kind == OpeningKind::kWallFace && steepness < std::sin(kFlat_rad)) {
    return false;
  }
  if (!wall) {
    return nav::line_of_sight(occupancy, eye, opening.p_map, sight);
  }
  const Point2 along = opening.outward_map;
  const Point2 across(-along.y(), along.x());
  const double off = across.dot(eye - opening.p_map);
  if (std::abs(off) < std::sin(kFlat_rad) * (eye - opening.p_map).norm()) {
    return false;
  }
  const Point2 before = target + std::copysign(kOffWall_m, off) * across;
  return nav::line_of_sight(occupancy, eye, before, sight);
}

bool find_viewpoint(Opening& opening, const SideView& side, const OpeningsInput& input, const ViewpointParams& params) {
  const Point2 across(-side.into_map.y(), side.into_map.x());
  bool found = false;
  for (const double distance_m : side.distances_m) {
    for (const double angle_deg : kViewAngles_deg) {
      const double a = deg_to_rad(angle_deg);
      const Point2 place = side.p_map + distance_m * (std::sin(a) * across - std::cos(a) * side.into_map);
      const auto cost = input.costs.cost_to(place);
      if (!cost || (found && *cost >= opening.cost)) {
        continue;
      }
      const Point2 to_side = side.p_map - place;
      const Pose2 view{place.x(), place.y(), std::atan2(to_side.y(), to_side.x())};
      if (well_in_view(opening, view, input.floor.occupancy, params)) {
        opening.map_T_view = view;
        opening.cost = *cost;
        found = true;
      }
    }
  }
  return found;
}

}  // namespace seeker::explore
