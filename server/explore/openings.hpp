/// \file
/// Openings, the places that are left to explore: frontiers, ends of mapped walls that may extend further, and sides of
/// walls that were not observed; each with a viewpoint from which it would be observed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/map_move.hpp"
#include "common/core/mapped_side.hpp"
#include "common/core/time.hpp"
#include "common/core/unreachable.hpp"
#include "server/explore/viewpoint_params.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/planner.hpp"

namespace seeker::explore {

enum class OpeningKind : std::uint8_t {
  kFrontier,  ///< frontier: border between reachable free floor and unknown space (Yamauchi 1997)
  kWallEnd,   ///< virtual end of a segment, beyond which the wall may extend (spec S1.11: it would add to V)
  /// Border of free floor that the robot sees but is too wide for, such as the floor before the back of a wall whose
  /// front is mapped; also a border along a wall that was seen, but always at too flat an angle for a line.
  kWallFace,
};

struct Opening {
  std::uint64_t id = 0;  ///< stays the same as long as the opening is recognised; never 0
  OpeningKind kind = OpeningKind::kFrontier;
  Point2 p_map = Point2::Zero();         ///< where the unknown begins
  Point2 outward_map = Point2::UnitX();  ///< unit vector into the unknown
  Pose2 map_T_view;           ///< viewpoint: a reachable pose from which the opening would be observed, facing it
  double cost = 0.0;          ///< cost of the path to the viewpoint (nav::DistanceField)
  double size_m = 0.0;        ///< length of the border, or possible extension of the wall, in metres
  std::uint64_t segment = 0;  ///< id of the segment of a kWallEnd
  int visits = 0;             ///< number of good observations of it that changed nothing
  bool resting = false;       ///< true: a drive there failed lately, so that other openings are tried first
};

/// Description for people: "the border of unknown floor (2.3 m)", "the end of wall 17".
[[nodiscard]] std::string describe(const Opening& opening);

/// The data in which openings are searched. `costs` is computed on floor.cost, from the robot.
struct OpeningsInput {
  const nav::FloorView& floor;
  const nav::DistanceField& costs;
  const std::vector<MapSegment>& segments;
  const nav::ForbiddenAreas& areas;
  Pose2 map_T_base;
  RobotTime now;      ///< mission time, which stands still while the exploration is paused
  bool walls = true;  ///< true: ends and faces of walls too; false: frontiers alone
  /// Whether to include faces that were seen but belong to no segment: furniture looks like them until it has been
  /// observed well.
  bool seen_faces = true;
  /// Sides of walls that other robots have mapped: they need no visit of this one.
  std::span<const MappedSide> others_sides = {};
};

/// Remembers what was observed and what could not be reached, so that an exploration always ends. An opening that does
/// not change over max_visits good observations is settled (glass, furniture before a wall), and one that max_failures
/// drives have not reached is given up. Openings are recognised by their place, within same_m, and faces of a wall also
/// by their side.
class Openings {
 public:
  explicit Openings(const ViewpointParams& params);

  /// All present openings, in order of rising path cost. The call also records which openings the robot observes well
  /// from its present pose.
  [[nodiscard]] std::vector<Opening> find(const OpeningsInput& input);
  /// Records that the robot stood at the opening's viewpoint for look_s.
  void looked(const Opening& opening, RobotTime now);
  /// Records that a drive to the opening failed.
  void failed(const Opening& opening, RobotTime now);
  /// Places that no drive could reach, except those observed from elsewhere since (as of the last find()), each with
  /// the size of what is left there.
  [[nodiscard]] std::vector<UnreachablePlace> given_up() const;
  /// Allows openings that were given up to be tried once more, because a person who blocked the path may have moved on.
  void try_again();
  /// The map was corrected. A place between two corrected pieces may move with either of them, so for a while
  /// remembered openings are recognised within a larger distance and take their place from the openings that are found.
  void transform(const MapMove& move);

 private:
  struct Memory {
    std::uint64_t id = 0;
    OpeningKind kind = OpeningKind::kFrontier;
    Point2 p_map;
    Point2 outward_map;
    double size_m = 0.0;  ///< as it was found last
    int visits = 0;
    int failures = 0;
    RobotTime looked_at;  ///< time of the last counted observation
    RobotTime failed_at;
    /// Distance by which corrections of the map may have displaced it since it was last found; it is recognised within
    /// this distance.
    double slack_m = 0.0;
    bool gone = false;  ///< given up, and no opening is there any more
  };

  /// Whether the map was corrected recently, judged by the calls of find() since.
  [[nodiscard]] bool is_settling() const;
  [[nodiscard]] Memory& memory_of(const Opening& opening);
  void count_look(Memory& memory, RobotTime now) const;
  [[nodiscard]] bool is_open(Opening& opening, const OpeningsInput& input);
  [[nodiscard]] bool still_there(const Memory& memory, const OpeningsInput& input) const;

  ViewpointParams params_;
  std::vector<Memory> memories_;
  std::uint64_t next_id_ = 1;
  RobotTime now_;       ///< time of the last find()
  bool moved_ = false;  ///< whether the map was corrected since then
  RobotTime moved_at_;  ///< time of the first find() after a correction
};

/// Frontiers with viewpoints, in order of rising path cost; ids, visits and resting are not set yet.
[[nodiscard]] std::vector<Opening> frontier_openings(const OpeningsInput& input, const ViewpointParams& params);
/// Ends of walls that may extend further, except those that cannot be observed from any place.
[[nodiscard]] std::vector<Opening> wall_end_openings(const OpeningsInput& input, const ViewpointParams& params);

/// Faces of walls that were not observed yet, except those that cannot be observed from any place.
[[nodiscard]] std::vector<Opening> wall_face_openings(const OpeningsInput& input, const ViewpointParams& params);

/// Possible extension of the wall beyond its virtual end: up to the next wall, or to floor that is known to be free.
[[nodiscard]] double possible_extension_m(const nav::CostMap& map, const std::vector<MapSegment>& segments,
                                          const MapSegment& segment, bool left, double max_m,
                                          std::span<const MappedSide> others_sides = {});

/// Whether a robot at the pose observes the opening well: near enough, not at too flat an angle, and with nothing in
/// between.
[[nodiscard]] bool well_in_view(const Opening& opening, const Pose2& map_T_base, const Grid<std::uint8_t>& occupancy,
                                const ViewpointParams& params);

/// The places from which the side of an object or wall is observed.
struct SideView {
  Point2 p_map;                         ///< the point to observe
  Point2 into_map;                      ///< unit vector perpendicular to the side, into it
  std::span<const double> distances_m;  ///< distances of the viewpoints from the point, the best first
};

/// Gives the opening the viewpoint with the lowest path cost from which it is well in view; false: there is none.
[[nodiscard]] bool find_viewpoint(Opening& opening, const SideView& side, const OpeningsInput& input,
                                  const ViewpointParams& params);

/// Free floor that was observed but that no path leads to.
struct CutOffFloor {
  Point2 p_map = Point2::Zero();  ///< a place on it, frame `map`
  std::vector<CellIndex> cells;   ///< all its cells in the cost map
  double area_m2 = 0.0;
};

/// The floor as a place that cannot be reached, as wide as a square of its area.
[[nodiscard]] UnreachablePlace unreachable_place(const CutOffFloor& floor);

/// Every connected part of such floor with at least `min_m2`.
[[nodiscard]] std::vector<CutOffFloor> cut_off_floor(const nav::CostMap& map, const nav::DistanceField& costs,
                                                     double min_m2);

}  // namespace seeker::explore
