/// \file
/// What is left to explore: borders of unknown floor, ends of mapped walls that may go on, and sides of walls that
/// nobody has seen; each with a place from which it would be seen.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/map_move.hpp"
#include "common/core/time.hpp"
#include "server/explore/viewpoint_params.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/planner.hpp"

namespace seeker::explore {

enum class OpeningKind : std::uint8_t {
  kFrontier,  ///< border between free floor that the robot can reach and the unknown (Yamauchi 1997)
  kWallEnd,   ///< virtual end of a segment, beyond which the wall may go on (spec S1.11: it would add to V)
  /// Border of free floor that the robot sees but is too wide for, as before the back of a wall whose front is mapped;
  /// also along a wall that it has seen, but never steeply enough for a line.
  kWallFace,
};

struct Opening {
  std::uint64_t id = 0;  ///< stays the same while it is the same opening; never 0
  OpeningKind kind = OpeningKind::kFrontier;
  Point2 p_map = Point2::Zero();         ///< where the unknown begins
  Point2 outward_map = Point2::UnitX();  ///< unit vector into it
  Pose2 map_T_view;                      ///< a reachable place from which it would be seen, facing it
  double cost = 0.0;                     ///< of the way there (nav::DistanceField)
  double size_m = 0.0;                   ///< length of the border, or by how much the wall may be longer
  std::uint64_t segment = 0;             ///< of kWallEnd
  int visits = 0;                        ///< good looks at it that changed nothing
  bool resting = false;                  ///< a drive there failed lately: others first
};

/// For people: "the border of unknown floor (2.3 m)", "the end of wall 17".
[[nodiscard]] std::string describe(const Opening& opening);

/// What openings are looked for in. `costs` is of floor.cost, from the robot.
struct OpeningsInput {
  const nav::FloorView& floor;
  const nav::DistanceField& costs;
  const std::vector<MapSegment>& segments;
  const nav::ForbiddenAreas& areas;
  Pose2 map_T_base;
  RobotTime now;      ///< stands still while the exploration is paused
  bool walls = true;  ///< ends and faces of walls too; false: borders of unknown floor alone
  /// Faces that were seen, but that no segment holds: furniture looks like them until it has been looked at.
  bool seen_faces = true;
};

/// Remembers what was looked at and what could not be reached, so that an exploration always ends: an opening that
/// does not change by max_visits good looks is settled (glass, furniture before a wall), and one that max_failures
/// drives have not reached is given up. Openings are recognised again by their place, within same_m, and the faces of
/// a wall by their side.
class Openings {
 public:
  explicit Openings(const ViewpointParams& params);

  /// Everything open now, cheapest first. Also takes note of what the robot sees well from where it stands.
  [[nodiscard]] std::vector<Opening> find(const OpeningsInput& input);
  /// The robot stood at the opening's viewpoint for look_s.
  void looked(const Opening& opening, RobotTime now);
  /// A drive there failed.
  void failed(const Opening& opening, RobotTime now);
  /// Places that no drive could reach, unless they have been seen from elsewhere since (as of the last find()).
  [[nodiscard]] std::vector<Point2> given_up() const;
  /// Who stood in the way may have gone on: what was given up may be driven to once more.
  void try_again();
  /// The map moved. A place between two pieces of it may go with either: for a while what is remembered is recognised
  /// by a wider measure and takes its place from what is found.
  void transform(const MapMove& move);

 private:
  struct Memory {
    std::uint64_t id = 0;
    OpeningKind kind = OpeningKind::kFrontier;
    Point2 p_map;
    Point2 outward_map;
    int visits = 0;
    int failures = 0;
    RobotTime looked_at;  ///< the last counted look
    RobotTime failed_at;
    /// How far corrections of the map have moved it since it was last found: it is looked for so far about.
    double slack_m = 0.0;
    bool gone = false;  ///< given up, but nothing is open there any more
  };

  /// The map was corrected lately, as far as find() was called since.
  [[nodiscard]] bool is_settling() const;
  [[nodiscard]] Memory& memory_of(const Opening& opening);
  void count_look(Memory& memory, RobotTime now) const;
  [[nodiscard]] bool is_open(Opening& opening, const OpeningsInput& input);
  [[nodiscard]] bool still_there(const Memory& memory, const OpeningsInput& input) const;

  ViewpointParams params_;
  std::vector<Memory> memories_;
  std::uint64_t next_id_ = 1;
  RobotTime now_;       ///< of the last find()
  bool moved_ = false;  ///< the map was corrected since then
  RobotTime moved_at_;  ///< of the first find() after a correction
};

/// Borders of unknown floor with viewpoints, cheapest first; ids, visits and resting not yet set.
[[nodiscard]] std::vector<Opening> frontier_openings(const OpeningsInput& input, const ViewpointParams& params);
/// Ends of walls that may go on, without those that cannot be looked at from anywhere.
[[nodiscard]] std::vector<Opening> wall_end_openings(const OpeningsInput& input, const ViewpointParams& params);

/// Faces of walls that nobody has seen, without those that cannot be looked at from anywhere.
[[nodiscard]] std::vector<Opening> wall_face_openings(const OpeningsInput& input, const ViewpointParams& params);

/// How far the wall may go on beyond its virtual end: up to the next segment, or to where the floor is known to be
/// free.
[[nodiscard]] double possible_extension_m(const nav::CostMap& map, const std::vector<MapSegment>& segments,
                                          const MapSegment& segment, bool left, double max_m);

/// Whether somebody at the pose sees what is at the opening: near enough, not too flat, nothing in between.
[[nodiscard]] bool well_in_view(const Opening& opening, const Pose2& map_T_base, const Grid<std::uint8_t>& occupancy,
                                const ViewpointParams& params);

/// From where the side of something is looked at.
struct SideView {
  Point2 p_map;                         ///< what is looked at
  Point2 into_map;                      ///< unit vector square into the side
  std::span<const double> distances_m;  ///< of the places from it, best first
};

/// Gives the opening the cheapest of the places before the side from which it is well in view; false: there is none.
[[nodiscard]] bool find_viewpoint(Opening& opening, const SideView& side, const OpeningsInput& input,
                                  const ViewpointParams& params);

/// Free floor that was seen but that no way leads to.
struct CutOffFloor {
  Point2 p_map = Point2::Zero();  ///< a place of it
  std::vector<CellIndex> cells;   ///< all of it, of the cost map
};

/// Every connected part of at least `min_m2`.
[[nodiscard]] std::vector<CutOffFloor> cut_off_floor(const nav::CostMap& map, const nav::DistanceField& costs,
                                                     double min_m2);

}  // namespace seeker::explore
